// What the step control promises (step/gas_step_control.cpp): it starts from v_rms h / d = 0.1, grows by at most 3 % a
// call and only in thin gas, never falls below half the rule, keeps the cap, and holds still while particles wait for
// the detonation. Exact statements; no tolerance but rounding.
#include <gtest/gtest.h>

#include "tests/unit/particles_gas_scenes.hpp"

namespace standoff::particles {
namespace {

double rule(const GasState& gas) {
  const double mean_square = 2.0 * (gas_totals(gas).kinetic + gas_totals(gas).waiting) / (gas.mass * gas.size());
  return 0.1 * 2.0 * gas.radius / std::sqrt(mean_square);
}

GasCollideCounts after_rounds(int usual, long candidates = 10) {
  GasCollideCounts counts;
  counts.rounds = usual + 2, counts.usual_rounds = usual, counts.searches = 100, counts.candidates = 100 * candidates;
  return counts;
}

TEST(GasStep_AtFirst_IsATenthOfADiameterOrTheCap, RuleAndCap) {
  const GasState gas = test::lattice_gas(3, 0.2, 5.0 / 3.0, 0.0);
  const GasCollide collide({});
  EXPECT_NEAR(collide.suggest_step(gas, {}, 0.0, 1.0), rule(gas), 1e-14);
  EXPECT_EQ(collide.suggest_step(gas, {}, 0.0, 1e-9), 1e-9);
  EXPECT_EQ(collide.suggest_step(GasState{}, {}, 0.0, 0.5), 0.5) << "no gas, no limit";
}

TEST(GasStep_FewRounds_GrowsSlowly, ManyRoundsOrLongSearchesShrinkIt) {
  const GasState gas = test::lattice_gas(3, 0.2, 5.0 / 3.0, 0.0);
  const GasCollide collide({});
  const double h = 3.0 * rule(gas);
  EXPECT_NEAR(collide.suggest_step(gas, after_rounds(2), h, 1.0), 1.03 * h, 1e-14);
  EXPECT_EQ(collide.suggest_step(gas, after_rounds(4), h, 1.0), h);
  EXPECT_LT(collide.suggest_step(gas, after_rounds(7), h, 1.0), h);
  EXPECT_LT(collide.suggest_step(gas, after_rounds(2, 200), h, 1.0), h);
  EXPECT_NEAR(collide.suggest_step(gas, after_rounds(50), 0.01 * h, 1.0), 0.5 * rule(gas), 1e-14);
}

TEST(GasStep_WhileGasWaits_StaysAtTheRule, NoGrowth) {
  GasState gas = test::lattice_gas(3, 0.2, 5.0 / 3.0, 0.0);
  const double expected = rule(gas);
  gas.released.assign(gas.size(), 0), gas.release_time.assign(gas.size(), 1.0);
  const GasCollide collide({});
  EXPECT_NEAR(collide.suggest_step(gas, after_rounds(1), 5.0 * expected, 1.0), expected, 1e-14);
}

TEST(GasStep_FreeExpansion_GrowsManyTimes, WithinAFewPercentACall) {
  GasState gas = test::lattice_gas(6, 0.2, 1.4, 2.0 / 3.0);
  GasCollide collide({});
  double last = 0.0, first = 0.0;
  test::run_gas(collide, gas, nullptr, nullptr, 200, 1e9, [&](const GasCollideCounts&, double h) {
    if (last == 0.0) {
      first = h;
    } else {
      EXPECT_LE(h, 1.0301 * std::max(last, rule(gas)));
    }
    last = h;
  });
  EXPECT_GT(last, 5.0 * first);
}

}  // namespace
}  // namespace standoff::particles
