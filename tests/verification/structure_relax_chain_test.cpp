// Twenty masses, soft hardening springs (2e6 N/m + 1e10 N/m^3) alternating with stiff ones (3e9 N/m): modes from 106 Hz
// to 55 kHz, ratio 5e2, all of them set in motion. Reference: the explicit damped leapfrog, which resolves every mode.
// Tolerance between the two: 5 um for a plate that deflects 20 mm, the same fraction (2.5e-4) of the peak deflection
// here.
#include <cmath>

#include <gtest/gtest.h>

#include "structure_solver/relaxation/relaxation.hpp"
#include "tests/unit/structure_relax_mocks.hpp"

namespace standoff::structure {
namespace {

constexpr std::size_t n = 20;

test::SpringChain thrown_chain(double yield) {
  std::vector<test::Spring> springs(n, test::Spring{2e6, yield, 1e5, 1e10});
  for (std::size_t i = 1; i < n; i += 2) springs[i] = test::Spring{3e9};
  test::SpringChain c(std::vector<double>(n, 0.05), springs);
  for (std::size_t i = 0; i < n; ++i)
    c.v[i] = 60.0 * static_cast<double>(i + 1) / n + 5.0 * (static_cast<double>(i * 7 % 3) - 1.0);
  return c;
}

struct Relaxed {
  RelaxationResult result;
  test::SpringChain chain;
  double energy_before = 0.0;
};

Relaxed relax(test::SpringChain chain, RelaxationOptions options) {
  Relaxed r{{}, std::move(chain)};
  r.energy_before = r.chain.energy();
  options.peak_kinetic_energy = r.chain.kinetic();
  options.time_cap = options.time_cap == RelaxationOptions{}.time_cap ? 1.0 : options.time_cap;
  r.result = relax_to_rest(r.chain, options);
  return r;
}

RelaxationOptions reference() {
  RelaxationOptions options;
  options.method = RelaxationMethod::explicit_leapfrog;
  options.polish = false;
  // A fifth of the stability limit (4.9 us): the stiff modes yield springs too, so their phase matters. Halving it
  // again moves nothing by more than a tenth of the tolerance.
  options.explicit_step = 1e-6;
  return options;
}

TEST(RelaxedChain, ThrownHardEnoughToYield_AgreesWithExplicitLeapfrog) {
  const Relaxed a = relax(thrown_chain(4e3), {}), b = relax(thrown_chain(4e3), reference());
  ASSERT_TRUE(a.result.at_rest) << a.result.message;
  ASSERT_TRUE(b.result.at_rest) << b.result.message;
  ASSERT_GT(a.chain.plastic_work(), 0.05 * a.energy_before) << "the path must matter";
  const double allowed = 2.5e-4 * b.chain.peak;
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(a.chain.u[i], b.chain.u[i], allowed) << "m, mass " << i << ", peak " << b.chain.peak << " m";
  EXPECT_LT(a.result.residual, 1e-3) << "N";
  // Two or three Newton iterations a step, one or two GMRES iterations each with the factor; about twenty without.
  EXPECT_LT(a.result.linear_iterations, 6 * a.result.steps) << "the preconditioner does not work";
}

// The static solve ends below 1e-3 N and the softest stiffness, all twenty springs in series, is about 2e5 N/m.
TEST(RelaxedChain, Elastic_ReturnsToZero) {
  const Relaxed a = relax(thrown_chain(1e300), {});
  EXPECT_TRUE(a.result.at_rest) << a.result.message;
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(a.chain.u[i], 0.0, 1e-3 / 2e5) << "m, mass " << i;
  EXPECT_EQ(a.result.plastic_work_gained, 0.0);
}

// Booked by difference: rounding. By the integral of the damping power: BDF itself takes energy out of modes it does
// not resolve, a few per cent; the leapfrog only what the quadrature misses.
TEST(RelaxedChain, YieldingOrNot_EnergiesClose) {
  for (const double yield : {4e3, 1e300}) {
    Relaxed a = relax(thrown_chain(yield), {}), b = relax(thrown_chain(yield), reference());
    for (Relaxed* r : {&a, &b})
      EXPECT_NEAR(r->chain.energy() + r->chain.damping, r->energy_before, 1e-9 * r->energy_before) << "J";
    EXPECT_NEAR(a.result.damping_integral, a.result.damping_energy, 0.05 * a.energy_before) << "J, implicit";
    EXPECT_NEAR(b.result.damping_integral, b.result.damping_energy, 0.01 * b.energy_before) << "J, explicit";
  }
}

TEST(RelaxedChain, Repeated_GivesTheSameBits) {
  const Relaxed a = relax(thrown_chain(4e3), {}), b = relax(thrown_chain(4e3), {});
  EXPECT_EQ(a.chain.hash(), b.chain.hash());
  EXPECT_EQ(a.result.force_calls, b.result.force_calls);
}

TEST(RelaxedChain, TenthAndTenfoldDamping_CannotRestWithinTheCap_SaysWhy) {
  for (const double factor : {0.1, 10.0}) {
    RelaxationOptions options;
    options.damping_factor = factor;
    options.time_cap = 20e-3;  // two periods of the softest mode
    const Relaxed a = relax(thrown_chain(4e3), options);
    EXPECT_FALSE(a.result.at_rest);
    EXPECT_FALSE(a.result.polished) << "a moving structure must not be pushed into equilibrium";
    EXPECT_NE(a.result.message.find("not at rest after 20"), std::string::npos) << a.result.message;
    EXPECT_NE(a.result.message.find(factor < 1.0 ? "kinetic energy is" : "the centre moved"), std::string::npos)
        << a.result.message;
  }
}

}  // namespace
}  // namespace standoff::structure
