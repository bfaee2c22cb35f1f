// One mass on one spring that yields: closed forms.
//
// A. No flow left: swinging elastically about its permanent set p, it must come to rest at u = p, from wherever in the
// swing it
//    starts and however it is damped. The static solve ends below 1e-3 N, so |u - p| < 1e-3 N / k = 1e-10 m.
// B. Flow during the motion: from the yield point with speed v0, force Y constant, m v' = -Y - alpha m v, so it flows
// until
//    t* = ln(1 + alpha v0 / g) / alpha, g = Y / m, and keeps p = v0 / alpha - g / alpha^2 ln(1 + alpha v0 / g).
//    Every one of the N steps until t* may err by rtol |u|; errors add at most linearly: |error| < N rtol p. N is not
//    known beforehand, the whole motion takes a few hundred steps; the bound uses 25 of them, and five times less at
//    rtol / 10.
#include <cmath>

#include <gtest/gtest.h>

#include "structure_solver/relaxation/relaxation.hpp"
#include "tests/unit/structure_relax_mocks.hpp"

namespace standoff::structure {
namespace {

constexpr double m = 1.0, k = 1e7, yield = 5e4, set = 0.02;  // kg, N/m, N, m: 503 Hz, yields at 5 mm

/// At `phase` of an elastic swing about the permanent set; 0 is the far turning point.
test::SpringChain swinging(double phase, double amplitude = 0.999 * yield / k) {
  test::SpringChain c({m}, {test::Spring{k, yield}});
  c.plastic[0] = set;
  c.work = yield * set;
  c.u[0] = set + amplitude * std::cos(phase);
  c.v[0] = -amplitude * std::sqrt(k / m) * std::sin(phase);
  return c;
}

RelaxationResult relax(test::SpringChain& c, RelaxationOptions options = {}) {
  options.peak_kinetic_energy = 1000.0;
  return relax_to_rest(c, options);
}

class RelaxedSpring : public ::testing::TestWithParam<double> {};

TEST_P(RelaxedSpring, SwingingElastically_RestsAtItsPermanentSet) {
  test::SpringChain c = swinging(GetParam());
  const RelaxationResult result = relax(c);
  EXPECT_TRUE(result.at_rest) << result.message;
  EXPECT_NEAR(c.u[0], set, 1e-3 / k) << "m; " << result.message;
  EXPECT_EQ(c.plastic[0], set) << "flowed although below yield";
  EXPECT_NEAR(result.first_frequency, std::sqrt(k / m) / 6.283185307, 0.01);
}
INSTANTIATE_TEST_SUITE_P(FromPeakMidSwingAndBetween, RelaxedSpring, ::testing::Values(0.0, 0.8, 1.5707963, 2.5, 4.0));

TEST(RelaxedSpringDamping, TenfoldAndTenth_RestsAtTheSamePlace) {
  for (const double factor : {0.1, 10.0}) {
    test::SpringChain c = swinging(1.0);
    RelaxationOptions options;
    options.damping_factor = factor;
    options.time_cap = 0.5;
    const RelaxationResult result = relax(c, options);
    EXPECT_TRUE(result.at_rest) << "factor " << factor << ": " << result.message;
    EXPECT_NEAR(c.u[0], set, 1e-3 / k) << "m, factor " << factor;
  }
}

TEST(RelaxedSpringAtRest, NothingToDo_StaysWhereItIs) {
  test::SpringChain c = swinging(0.0, 0.0);
  const RelaxationResult result = relax(c);
  EXPECT_TRUE(result.at_rest) << result.message;
  EXPECT_EQ(c.u[0], set);
  EXPECT_EQ(result.polish_difference, 0.0);
  EXPECT_EQ(result.damping_energy, 0.0);
}

double flow_of_closed_form(double v0) {
  const double alpha = 2.0 * std::sqrt(k / m), g = yield / m;
  return v0 / alpha - g / (alpha * alpha) * std::log(1.0 + alpha * v0 / g);
}

TEST(RelaxedSpringFlow, ThrownFromTheYieldPoint_KeepsTheFlowOfClosedForm) {
  for (const auto& [method, rtol, steps] :
       {std::tuple{RelaxationMethod::implicit, 1e-4, 25.0}, std::tuple{RelaxationMethod::implicit, 1e-5, 50.0},
        std::tuple{RelaxationMethod::explicit_leapfrog, 1e-5, 50.0}}) {
    test::SpringChain c({m}, {test::Spring{k, yield}});
    c.u[0] = yield / k;
    c.v[0] = 200.0;
    RelaxationOptions options;
    options.method = method;
    options.relative_tolerance = rtol;
    options.explicit_step = 1e-7;  // 1e-4 of the period: second order, far below the bound
    const double flow = flow_of_closed_form(c.v[0]);
    const RelaxationResult result = relax(c, options);
    EXPECT_TRUE(result.at_rest) << result.message;
    EXPECT_NEAR(c.u[0], flow, steps * rtol * flow) << "m, rtol " << rtol << ", " << result.steps << " steps";
    EXPECT_NEAR(c.u[0], c.plastic[0], 1e-3 / k) << "springback complete";
  }
}

// What damping took is booked by difference, so the ledger closes to rounding. The integral of the damping power, by
// the trapezoidal rule over steps that keep the velocity to 1e-4 each, must agree with it: 200 steps, so within 2 %.
TEST(RelaxedSpringEnergy, ThrownFromTheYieldPoint_LedgerCloses) {
  test::SpringChain c({m}, {test::Spring{k, yield}});
  c.u[0] = yield / k;
  c.v[0] = 20.0;
  const double before = c.energy();
  const RelaxationResult result = relax(c);
  EXPECT_NEAR(c.energy() + c.damping, before, 1e-9 * before) << "J";
  EXPECT_EQ(c.damping, result.damping_energy);
  EXPECT_NEAR(result.damping_integral, result.damping_energy, 0.02 * result.damping_energy) << "J";
}

// A load P above the static yield force Y creeps: p' = (P - Y - H p) / viscosity, 2e-8 m within a period, below any
// limit on drift, and yet the rest state is H p = P - Y, u = P / k + p, a millimetre away. Tolerance: 1e-3 N over k and
// over H.
TEST(RelaxedSpringCreep, LoadedAboveStaticYield_RestsWhereTheCreepWouldEnd) {
  const double hardening = 1e6, load = yield + 1e3;
  test::SpringChain c({m}, {test::Spring{k, yield, hardening, 0.0, 1e8}});
  c.load = load;
  c.u[0] = load / k + 1e-5;
  c.work = 1.0;
  const RelaxationResult result = relax(c);
  EXPECT_TRUE(result.at_rest) << result.message;
  EXPECT_NEAR(c.u[0], load / k + (load - yield) / hardening, 1e-3 / k + 1e-3 / hardening) << "m; " << result.message;
  EXPECT_NEAR(result.polish_difference, 1e-3, 2e-5) << "m, the creep that was left";
}

// A cubic spring swings stiffly far out and softly near rest: damped for the start, the soft motion decays with omega^2
// / alpha = 0.9 per second. The review must find the softer frequency.
TEST(RelaxedSpringReview, SofterAtRestThanAtTheStart_DampingFollowsAndRestIsReached) {
  test::SpringChain c({m}, {test::Spring{1e5, 1e300, 0.0, 1e13}});
  c.u[0] = 0.01;  // 3e9 against 1e5 N/m
  RelaxationOptions options;
  options.peak_kinetic_energy = 1e4;
  options.time_cap = 0.3;  // 15 periods at rest; with the first damping it would take ten seconds
  const RelaxationResult result = relax_to_rest(c, options);
  EXPECT_NE(result.message.find("damping was set to the frequency of the present state"), std::string::npos)
      << result.message;
  EXPECT_TRUE(result.at_rest) << result.message;
  EXPECT_NEAR(c.u[0], 0.0, 1e-3 / 1e5) << "m";
}

}  // namespace
}  // namespace standoff::structure
