// Two hundred springs in a row, every tenth a thousand times stiffer: modes from 8 Hz to 45 kHz, moved in the softest
// one only. With the Cholesky factor each Newton matrix is solved by GMRES in a few iterations, whatever the number of
// masses, and the steps follow the soft mode. Without it GMRES needs as many iterations as there are masses between
// wall and end; 40 are allowed. Bounds: a linear structure takes one Newton iteration a step, rarely two; a factor
// whose gamma is off by r needs ln(1e-3) / ln((r - 1) / (r + 1)) iterations, 6 for r = 2, and is renewed when such
// waste adds up: on average below 4 a step.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "structure_solver/relaxation/damped_motion.hpp"
#include "structure_solver/relaxation/relaxation.hpp"
#include "structure_solver/relaxation/static_polish.hpp"
#include "tests/unit/structure_relax_mocks.hpp"

namespace standoff::structure {
namespace {

constexpr std::size_t n = 200;

test::SpringChain long_chain() {
  std::vector<test::Spring> springs(n, test::Spring{2e6});
  for (std::size_t i = 9; i < n; i += 10) springs[i].stiffness = 2e9;
  return {std::vector<double>(n, 0.05), springs};
}

TEST(ImplicitRelaxation, LongStiffChainInItsSoftestMode_FewIterationsAndFewSteps) {
  test::SpringChain c = long_chain();
  for (std::size_t i = 0; i < n; ++i) c.v[i] = 20.0 * std::sin(0.5 * std::numbers::pi * (i + 1.0) / n);
  RelaxationOptions options;
  options.peak_kinetic_energy = c.kinetic();
  options.time_cap = 2.0;
  const RelaxationResult result = relax_to_rest(c, options);
  EXPECT_TRUE(result.at_rest) << result.message;
  EXPECT_LT(result.linear_iterations, 4 * result.steps);
  // Three periods of 0.12 s. The leapfrog takes 7 us a step, 50,000 in all; an accuracy of 1e-4 with order 2 some 100 a
  // period.
  EXPECT_LT(result.steps, 1000);
}

TEST(StaticPolish, LongStiffChain_FewIterations) {
  test::SpringChain c = long_chain();
  for (std::size_t i = 0; i < n; ++i) c.u[i] = 1e-6 * std::cos(0.37 * static_cast<double>(i * i));
  c.v.assign(n, 0.01);  // over 52 rad/s the size of the displacements, 0.2 mm: the error above is small against it
  const RelaxationOptions options;
  DampedMotion motion(c, options, 52.0);
  StiffnessFactor stiffness(c.stiffness(c.u), c.mass());
  const PolishEnd end = polish(motion, stiffness);
  EXPECT_TRUE(end.accepted) << end.message;
  EXPECT_LT(end.residual, options.polish_residual) << "N";
  EXPECT_LT(end.linear_iterations, 20);
}

}  // namespace
}  // namespace standoff::structure
