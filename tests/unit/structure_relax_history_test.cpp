// History is written once per accepted step and nowhere else; a static solve that fails leaves every bit as it was.
// Counts and hashes are compared exactly.
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "structure_solver/relaxation/damped_motion.hpp"
#include "structure_solver/relaxation/relaxation.hpp"
#include "structure_solver/relaxation/static_polish.hpp"
#include "tests/unit/structure_relax_mocks.hpp"

namespace standoff::structure {
namespace {

using ::testing::HasSubstr;

/// Ten masses thrown hard enough that the springs yield during the relaxation. omega_1 about 940 rad/s.
test::SpringChain thrown_chain() {
  const test::Spring spring{2e6, 4e3, 1e5, 1e10, 20.0};
  test::SpringChain c(std::vector<double>(10, 0.05), std::vector<test::Spring>(10, spring));
  for (std::size_t i = 0; i < c.v.size(); ++i) c.v[i] = 12.0 * static_cast<double>(i + 1);
  return c;
}

RelaxationOptions options_for(const test::SpringChain& c) {
  RelaxationOptions options;
  options.peak_kinetic_energy = c.kinetic();
  return options;
}

TEST(RelaxationHistory, YieldingChain_CommitsOncePerAcceptedStep) {
  test::SpringChain c = thrown_chain();
  const RelaxationResult result = relax_to_rest(c, options_for(c));
  EXPECT_TRUE(result.at_rest) << result.message;
  EXPECT_GT(c.plastic_work(), 0.0);
  EXPECT_EQ(c.commits, result.steps);
  EXPECT_EQ(c.static_commits, result.polished ? 1 : 0);
  EXPECT_GT(c.forces, 2 * c.commits) << "trial evaluations must not commit";
  EXPECT_EQ(c.forces, result.force_calls);
}

TEST(RelaxationHistory, DampedMotion_NeverAsksForTheStaticFlow) {
  test::SpringChain c = thrown_chain();
  RelaxationOptions options = options_for(c);
  options.polish = false;
  options.time_cap = 2e-3;  // ends while moving: no residual is measured before the end
  const RelaxationResult result = relax_to_rest(c, options);
  EXPECT_EQ(c.static_forces, 1) << "the residual of the result";
  EXPECT_GT(c.smallest_dt, 0.0);
  EXPECT_FALSE(result.at_rest);
}

/// A motion over a chain displaced by 1 um, the first spring longer by 1 mm of plastic extension.
struct NearRest {
  NearRest() : c(thrown_chain()) {
    c.v.assign(10, 0.0);
    c.u.assign(10, 1e-3);
    c.plastic[0] = 1e-3;
    c.work = 1.0;
    for (std::size_t i = 0; i < 10; ++i) c.u[i] += 1e-6 * static_cast<double>(i % 3);
  }
  test::SpringChain c;
  RelaxationOptions options;
};

TEST(StaticPolish, NoForceInStaticSolve_StateAndHistoryKeepTheirBits) {
  NearRest s;
  s.c.no_static_force = true;
  DampedMotion motion(s.c, s.options, 900.0);
  StiffnessFactor stiffness(s.c.stiffness(s.c.u), s.c.mass());
  const std::uint64_t before = s.c.hash();
  const PolishEnd end = polish(motion, stiffness);
  EXPECT_FALSE(end.accepted);
  EXPECT_EQ(s.c.hash(), before);
  EXPECT_EQ(s.c.static_commits + s.c.commits, 0);
  EXPECT_THAT(end.message, HasSubstr("KIN_FIRST_SYSFUNC_ERR"));
  EXPECT_THAT(end.message, HasSubstr("nothing was changed"));
}

TEST(StaticPolish, OneIterationWithAWrongStiffness_StateAndHistoryKeepTheirBits) {
  NearRest s;
  s.c.u[4] += 5e-4;  // well into the cubic range: one Newton step cannot do
  s.options.polish_iterations = 1;
  DampedMotion motion(s.c, s.options, 900.0);
  s.c.stiffness_error = 5e8;
  StiffnessFactor stiffness(s.c.stiffness(s.c.u), s.c.mass());
  const std::uint64_t before = s.c.hash();
  const PolishEnd end = polish(motion, stiffness);
  EXPECT_FALSE(end.accepted) << end.message;
  EXPECT_EQ(s.c.hash(), before);
  EXPECT_EQ(s.c.static_commits + s.c.commits, 0);
}

TEST(StaticPolish, NearRest_ResidualFallsAndVelocityIsZero) {
  NearRest s;
  s.c.v.assign(10, 1e-4);
  DampedMotion motion(s.c, s.options, 900.0);
  StiffnessFactor stiffness(s.c.stiffness(s.c.u), s.c.mass());
  const PolishEnd end = polish(motion, stiffness);
  EXPECT_TRUE(end.accepted) << end.message;
  EXPECT_LT(end.residual, s.options.polish_residual);
  EXPECT_EQ(s.c.static_commits, 1);
  EXPECT_EQ(s.c.kinetic(), 0.0);
}

TEST(RelaxationHistory, PolishAlwaysFails_RestIsJudgedByTheMotionAndSaysSo) {
  test::SpringChain c = thrown_chain();
  RelaxationOptions options = options_for(c);
  options.time_cap = 60e-3;
  options.polish_iterations = 0;  // the solver's default; the forces fail instead
  c.no_static_force = true;
  const RelaxationResult result = relax_to_rest(c, options);
  EXPECT_FALSE(result.polished);
  EXPECT_FALSE(result.at_rest) << "without a static force there is no residual, so no certificate";
  EXPECT_THAT(result.message, HasSubstr("KIN_FIRST_SYSFUNC_ERR"));
}

// The heartbeat's exception (the run was interrupted) must reach the caller through the frames of the C library.
TEST(RelaxationHistory, ProgressThrows_ExceptionReachesTheCaller) {
  test::SpringChain c = thrown_chain();
  struct Interrupting : test::SpringChain {
    using SpringChain::SpringChain;
    bool internal_force(std::span<const double> at, double dt, std::span<double> f) override {
      if (forces > 50) throw Stop(ExitCode::interrupted, "interrupted");
      return SpringChain::internal_force(at, dt, f);
    }
  };
  Interrupting interrupting(std::vector<double>(3, 0.1), std::vector<test::Spring>(3, test::Spring{1e6}));
  interrupting.v.assign(3, 1.0);
  try {
    relax_to_rest(interrupting, options_for(interrupting));
    FAIL() << "no exception";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::interrupted);
  }
}

}  // namespace
}  // namespace standoff::structure
