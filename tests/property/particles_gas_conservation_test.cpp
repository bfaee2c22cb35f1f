// Law: every hit keeps momentum and energy to rounding, so a run of M hits keeps them to about sqrt(M) eps (random
// signs), M ~ 3e4 here: 4e-14; 1e-12 asked. Mirror planes take momentum normal to themselves only, and their books
// close the balance. The state is the same to the last bit for any number of threads.
#include <gtest/gtest.h>

#include "coupling/base/state_hash.hpp"
#include "tests/unit/particles_gas_scenes.hpp"

namespace standoff::particles {
namespace {

/// Equal and unequal grains on a lattice among the gas, none overlapping its neighbours.
SandState grains_between(int n, double radius, bool unequal) {
  SandState sand;
  sand.radius = radius, sand.mass = 2e-3;
  for (int cell = 0; cell < n * n * n; ++cell) {
    sand.position.push_back(Vec3{cell % n + 0.5, cell / n % n + 0.5, cell / n / n + 0.5} / static_cast<double>(n));
    sand.velocity.push_back({});
    sand.id.push_back(static_cast<std::uint32_t>(cell));
    if (unequal) sand.grain_radius.push_back(radius * (1.0 - 0.1 * (cell % 5)));
    if (unequal) sand.grain_mass.push_back(sand.mass * (1.0 - 0.1 * (cell % 5)));
  }
  sand.force.assign(sand.size(), {});
  return sand;
}

struct Sums {
  Vec3 momentum;
  double energy = 0.0;
};
Sums sums(const GasState& gas, const SandState& sand) {
  const GasTotals totals = gas_totals(gas);
  Sums result{totals.momentum, totals.energy()};
  for (std::size_t i = 0; i < sand.size(); ++i) {
    result.momentum += sand.velocity[i] * sand.mass_of(i);
    result.energy += 0.5 * sand.mass_of(i) * squared_norm(sand.velocity[i]);
  }
  return result;
}

class GasAmongGrains : public testing::TestWithParam<bool> {};

TEST_P(GasAmongGrains, WithMirrors_KeepsMomentumAndEnergy) {
  GasState gas = test::lattice_gas(6, 0.10, 1.4, 2.0 / 3.0);
  SandState sand = grains_between(6, 0.04, GetParam());
  GasCollideOptions options;
  options.mirrors.on = true;
  GasCollide collide(options);
  const Sums before = sums(gas, sand);
  Vec3 mirrors;
  long sand_hits = 0, mirror_hits = 0;
  test::run_gas(collide, gas, &sand, nullptr, 150, 1e9, [&](const GasCollideCounts& counts, double) {
    mirrors += counts.mirror_impulse;
    sand_hits += counts.sand_hits, mirror_hits += counts.mirror_hits;
    EXPECT_EQ(counts.deferred, 0);
  });
  const Sums after = sums(gas, sand);
  EXPECT_GT(sand_hits, 500);
  EXPECT_GT(mirror_hits, 100);
  EXPECT_NEAR(after.energy, before.energy, 1e-12 * before.energy);
  EXPECT_LT(norm(after.momentum + mirrors - before.momentum), 1e-12 * test::momentum_scale(gas));
  EXPECT_EQ(mirrors.z, 0.0);
  for (std::size_t i = 0; i < gas.size(); ++i) {
    EXPECT_GT(gas.position[i].x, -1e-12) << "the centre is mirrored at the plane; rounding only";
    EXPECT_GT(gas.position[i].y, -1e-12);
  }
}
INSTANTIATE_TEST_SUITE_P(EqualAndUnequal, GasAmongGrains, testing::Bool());

std::string hash_after_run(int threads) {
  GasState gas = test::lattice_gas(9, 0.30, 1.4, 0.0);  // 2916 particles: enough for the parallel branches
  SandState sand = grains_between(9, 0.02, true);
  GasCollideOptions options;
  options.mirrors.on = true, options.threads = threads, options.seed = 3;
  GasCollide collide(options);
  test::run_gas(collide, gas, &sand, nullptr, 40, 1e9, [](const auto&, double) {});
  StateHash hash;
  for (const auto* values : {&gas.position, &gas.velocity, &sand.position, &sand.velocity})
    hash.add(std::span<const Vec3>(*values));
  hash.add(std::span<const double>(gas.internal_energy));
  for (const std::uint32_t id : gas.id) hash.add(static_cast<std::uint64_t>(id));
  return hash.hex();
}

TEST(GasCollide_OneTwoThreeThreads_SameBits, StateHash) {
  const std::string one = hash_after_run(1);
  EXPECT_EQ(one, hash_after_run(1)) << "the same run twice";
  EXPECT_EQ(one, hash_after_run(2));
  EXPECT_EQ(one, hash_after_run(3));
}

TEST(GasCollide_TwoParticlesTouchingAndApproaching_FireAtOnce, AndOnlyOnce) {
  GasState gas = test::lattice_gas(1, 0.001, 5.0 / 3.0, 0.0);
  for (auto* values : {&gas.position, &gas.velocity}) values->resize(2);
  gas.id.resize(2), gas.internal_energy.resize(2), gas.plate_rebound.resize(2);
  gas.position = {{0, 0, 0}, {1.5 * gas.radius, 0, 0}};  // deep overlap
  gas.velocity = {{1, 0, 0}, {-1, 0.5, 0}};
  GasCollide collide({});
  const GasCollideCounts counts = collide.run(gas, nullptr, nullptr, 1.0, 1);
  EXPECT_EQ(counts.gas_hits, 1);
  EXPECT_EQ(gas.velocity[0], (Vec3{-1, 0, 0}));
  EXPECT_EQ(gas.velocity[1], (Vec3{1, 0.5, 0}));
}

}  // namespace
}  // namespace standoff::particles
