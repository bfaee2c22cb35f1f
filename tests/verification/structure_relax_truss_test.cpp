// Shallow two-bar truss under a dead load below its limit load: stable equilibrium before the limit point, where the
// stiffness vanishes, and an unstable one behind it (von Mises 1923; Bathe, Finite Element Procedures, ex. 6.3). An
// energy barrier lies between them, so with less energy than that the truss must come back to the first branch, however
// soft it is there. Tolerance: the static solve ends below 1e-3 N over the stiffness at rest; the reference root is
// bisected to rounding.
#include <gtest/gtest.h>

#include "structure_solver/relaxation/relaxation.hpp"
#include "structure_solver/relaxation/stiffness_factor.hpp"
#include "tests/unit/structure_relax_mocks.hpp"

namespace standoff::structure {
namespace {

constexpr double height = 0.1;

template <class Function>
double root(double low, double high, Function&& rises_above) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (rises_above(middle) ? high : low) = middle;
  }
  return low;
}

/// The truss with `fraction` of its limit load, and its three special points.
struct LoadedTruss {
  explicit LoadedTruss(double fraction) : truss(1.0, 1e6, 1.0, height) {
    limit = root(0.0, height, [&](double u) { return truss.bar_stiffness(u) < 0.0; });
    truss.load = fraction * truss.bar_force(limit);
    stable = root(0.0, limit, [&](double u) { return truss.bar_force(u) > truss.load; });
    unstable = root(limit, height, [&](double u) { return truss.bar_force(u) < truss.load; });
    barrier = truss.elastic_energy(std::vector{unstable}) - truss.elastic_energy(std::vector{stable});
  }
  RelaxationResult relax() {
    RelaxationOptions options;
    options.peak_kinetic_energy = barrier;
    options.time_cap = 10.0;
    return relax_to_rest(truss, options);
  }
  test::ShallowTruss truss;
  double limit, stable, unstable, barrier;
};

TEST(RelaxedTruss, KickedBelowItsBarrier_ReturnsToItsBranch) {
  for (const double fraction : {0.5, 0.9, 0.99, 0.999}) {
    LoadedTruss t(fraction);
    t.truss.u[0] = t.stable;
    t.truss.v[0] = std::sqrt(2.0 * 0.9 * t.barrier);
    const RelaxationResult result = t.relax();
    EXPECT_TRUE(result.at_rest) << fraction << " of the limit load: " << result.message;
    EXPECT_NEAR(t.truss.u[0], t.stable, 1e-3 / t.truss.bar_stiffness(t.stable))
        << "m, " << fraction << " of the limit load";
  }
}

// Past the limit point the stiffness is negative, but the truss is on its way back: it must say so and still arrive.
TEST(RelaxedTruss, BeyondTheLimitPoint_StiffnessIndefinite_SaysSoAndReturns) {
  LoadedTruss t(0.9);
  t.truss.u[0] = 0.5 * (t.limit + t.unstable);
  ASSERT_LT(t.truss.bar_stiffness(t.truss.u[0]), 0.0);
  const RelaxationResult result = t.relax();
  EXPECT_EQ(result.negative_modes, 1);
  EXPECT_NE(result.message.find("not positive definite"), std::string::npos) << result.message;
  EXPECT_TRUE(result.at_rest) << result.message;
  EXPECT_NEAR(t.truss.u[0], t.stable, 1e-3 / t.truss.bar_stiffness(t.stable)) << "m";
}

// Kicked over the barrier it snaps through and rests on the far branch, where the bars are in tension.
TEST(RelaxedTruss, KickedOverItsBarrier_SnapsThroughAndRestsThere) {
  LoadedTruss t(0.9);
  t.truss.u[0] = t.stable;
  t.truss.v[0] = std::sqrt(2.0 * 20.0 * t.barrier);
  const RelaxationResult result = t.relax();
  const double far = root(2.0 * height, 4.0 * height, [&](double u) { return t.truss.bar_force(u) > t.truss.load; });
  EXPECT_TRUE(result.at_rest) << result.message;
  EXPECT_NEAR(t.truss.u[0], far, 1e-3 / t.truss.bar_stiffness(far)) << "m";
}

// A tangent that is wrong, even indefinite, costs iterations, not equilibrium.
TEST(RelaxedSpringWithAWrongTangent, StiffnessIndefinite_RestsInEquilibrium) {
  for (const double error : {-2.5e6, -0.5e6, 4e6}) {
    test::SpringChain c(std::vector<double>(4, 0.3), std::vector<test::Spring>(4, test::Spring{2e6, 3e3, 1e5}));
    c.v = {5.0, 10.0, 15.0, 20.0};
    c.stiffness_error = error;
    RelaxationOptions options;
    options.peak_kinetic_energy = c.kinetic();
    options.time_cap = 1.0;
    const RelaxationResult result = relax_to_rest(c, options);
    EXPECT_TRUE(result.at_rest) << error << " N/m: " << result.message;
    EXPECT_TRUE(result.polished) << error << " N/m: " << result.message;
    EXPECT_LT(result.residual, 1e-3) << "N, with an error of " << error << " N/m";
    // In series without a load: every spring relaxed, so the masses stand where the plastic extensions put them.
    double place = 0.0;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(c.u[i], place += c.plastic[i], 4e-3 / 2e6) << "m, mass " << i;
  }
}

}  // namespace
}  // namespace standoff::structure
