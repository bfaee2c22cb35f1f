// Law: gas that waits for the detonation stands still and is never passed; energy, and momentum counting m v0 + J of
// the waiting and the books of the mirrors, are exact at every moment of the detonation. Tolerance 1e-12 as in the
// conservation test. "Never passed": no moving particle ends a sub-step inside a waiting one. A path against a sphere
// at rest is found exactly, whatever happens to others, so only rounding is left: positions of 0.2 m to 1e-16, a
// diameter of 1 mm: 1e-9 of d is ample.
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "particle_solver/packing/charge.hpp"
#include "tests/unit/particles_gas_scenes.hpp"

namespace standoff::particles {
namespace {

ChargeSpec c4(long particles, double fill) {
  ChargeSpec charge;
  charge.present = true;
  charge.explosive = {"c4", 1601.0, 8.7e9, 1.4, fill, 8190.0};
  charge.mass = 0.150, charge.radius = 0.0282, charge.detonator = {0, 0, 0.15 + 0.0282}, charge.particles = particles;
  return charge;
}

/// Deepest overlap of a moving with a waiting particle, in diameters; negative while they keep apart.
double deepest_overlap(const GasState& gas) {
  double deepest = -1e30;
  for (std::size_t i = 0; i < gas.size(); ++i)
    for (std::size_t j = 0; !gas.all_released() && gas.released[i] != 0 && j < gas.size(); ++j)
      if (gas.released[j] == 0)
        deepest = std::max(deepest, 1.0 - norm(gas.position[i] - gas.position[j]) / (2.0 * gas.radius));
  return deepest;
}

class Detonation : public testing::TestWithParam<double> {};

TEST_P(Detonation, WholeCharge_EnergyAndMomentumExactAndNobodyPassed) {
  GasState gas = build_charge(c4(4000, GetParam()), {0, 0, 0.15}, 4, 1);
  GasCollideOptions options;
  options.mirrors.on = true;
  GasCollide collide(options);
  const double energy = gas_totals(gas).energy(), scale = test::momentum_scale(gas);
  Vec3 mirrors;
  long wall_hits = 0;
  double deepest = -1e30, time = 0.0, last_moment = 0.0;
  test::run_gas(collide, gas, nullptr, nullptr, 200, 5e-8, [&](const GasCollideCounts& counts, double h) {
    mirrors += counts.mirror_impulse;
    wall_hits += counts.unreleased_hits;
    for (std::size_t i = 0; i < gas.released.size(); ++i) ASSERT_EQ(gas.released[i] != 0, gas.release_time[i] <= time);
    const GasTotals totals = gas_totals(gas);
    ASSERT_NEAR(totals.energy(), energy, 1e-12 * energy) << "at " << time * 1e6 << " us";
    ASSERT_LT(norm(totals.momentum + mirrors), 1e-12 * scale) << "at " << time * 1e6 << " us";
    if (!gas.all_released()) last_moment = time;
    deepest = std::max(deepest, deepest_overlap(gas));
    time += h;
  });
  EXPECT_TRUE(gas.all_released());
  EXPECT_TRUE(gas.release_time.empty() && gas.latent_impulse.empty());
  EXPECT_LE(last_moment, 2.0 * 0.0282 / 8190.0 + 5e-8);
  EXPECT_GT(wall_hits, 20) << "the test must exercise the wall";
  EXPECT_LT(deepest, 1e-9) << "diameters";
  EXPECT_GT(deepest, -0.01) << "moving and waiting gas must have met";
}
INSTANTIATE_TEST_SUITE_P(Fills, Detonation, testing::Values(0.10, 0.20, 0.35));

TEST(Detonate_UndisturbedParticle_IsReleasedWhenTheFrontArrives, DistanceOverSpeed) {
  GasState gas = build_charge(c4(400, 0.2), {0, 0, 0.15}, 4, 1);
  const double late = *std::max_element(gas.release_time.begin(), gas.release_time.end());
  for (std::size_t i = 0; i < gas.size(); ++i)
    EXPECT_DOUBLE_EQ(gas.release_time[i], norm(gas.position[i] - Vec3{0, 0, 0.1782}) / 8190.0);
  EXPECT_EQ(detonate(gas, 0.0), 0);
  const long first = detonate(gas, 3e-6);
  EXPECT_GT(first, 0);
  EXPECT_FALSE(gas.all_released());
  EXPECT_EQ(first + detonate(gas, late), 100);
  EXPECT_TRUE(gas.all_released());
}

TEST(Detonate_FromTheCentre_TheOutermostHandTheirRestToProducts, EnergyAndMomentumExact) {
  ChargeSpec charge = c4(800, 0.35);
  charge.detonator = {0, 0, 0.15};
  GasState gas = build_charge(charge, {0, 0, 0.15}, 1, 3);
  // More than all that wait could carry together: 1.5 times m sqrt(2 E / m) each, outwards, on every particle.
  const double energy = gas_totals(gas).energy(), each = 1.5 * std::sqrt(2.0 * energy * gas.mass / 800.0);
  for (std::size_t i = 0; i < gas.size(); ++i) {
    const Vec3 out = gas.position[i] - Vec3{0, 0, 0.15};
    gas.latent_impulse.add(gas.id[i], out / norm(out) * each);
  }
  const Vec3 momentum = gas_totals(gas).momentum;
  for (double time = 0.0; !gas.all_released(); time += 1e-7) {
    detonate(gas, time);
    ASSERT_NEAR(gas_totals(gas).energy(), energy, 1e-12 * energy);
    ASSERT_LT(norm(gas_totals(gas).momentum - momentum), 1e-12 * 800.0 * each);
  }
  for (const double e : gas.internal_energy) EXPECT_GE(e, 0.0);
}

TEST(Detonate_ImpulseBeyondAllEnergy_StopsWithAReason, NothingIsInvented) {
  GasState gas = build_charge(c4(400, 0.2), {0, 0, 0.15}, 4, 1);
  for (const std::uint32_t id : gas.id) gas.latent_impulse.add(id, {0.0, 0.0, -10.0});
  EXPECT_THROW(detonate(gas, 1.0), Stop);
}

}  // namespace
}  // namespace standoff::particles
