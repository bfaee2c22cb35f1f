// Hard core (kernels/hard_core.hpp): the elastic impact of smooth spheres. Momentum is exact, because an impulse acts
// with both signs: rounding only. Energy is exact in an impulse; around it the spring of grain_contact.hpp enters a
// contact within a step, which shifts energy by at most k (v dt)^2/8, twice [grain_contact.hpp], and no more than that.
#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/state_hash.hpp"
#include "particle_solver/kernels/hard_core.hpp"
#include "particle_solver/step/hard_core.hpp"
#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles {
namespace {

// Dry sand of 50,000 grains in the shell of the paper: k0 = 0.4 GN/m, cell of 64 mm.
constexpr double radius = 1.7e-3, mass = 5.6e-5, stiffness = 1.29e7;

struct Meeting {
  SandState grains;
  double energy_excess = 0.0, deepest = 0.0, bound = 0.0;
  Vec3 momentum_error;
  long hits = 0;
};

/// Two grains fly at each other, each with `speed`; run until they are far apart again, on either side.
Meeting meet(double speed, double across, bool core) {
  Meeting m;
  m.grains = make_grains({{-1.2 * radius, 0, 0}, {1.2 * radius, across, 0}}, radius, mass);
  m.grains.velocity = {{speed, 0, 0}, {-speed, 0, 0}};
  SandPairs pairs({{stiffness, 0.0, 0.0}, {}, {}, 0.0, 1});
  HardCore hard_core;
  pairs.forces(m.grains, 0.0);
  const double before = kinetic_energy(m.grains);
  for (double t = 0.0; t < 12.0 * radius / speed;) {
    const double step = std::min(pairs.stable_step(), HardCore::longest_step(m.grains));
    m.bound = std::max(m.bound, stiffness * 4.0 * speed * speed * step * step / 4.0);
    sand_step(m.grains, pairs, step);
    if (core) m.hits += hard_core.run(m.grains, pairs).hits;
    m.energy_excess = std::max(m.energy_excess, kinetic_energy(m.grains) + pairs.books().elastic_energy - before);
    t += step;
  }
  m.deepest = pairs.books().max_overlap_over_radius;
  m.momentum_error = momentum(m.grains);
  return m;
}

TEST(HardCore, TwoGrainsHeadOnFarAboveTheSpring_BounceInsteadOfPassingThrough) {
  for (const double speed : {2000.0, 8000.0}) {
    const Meeting m = meet(speed, 0.0, true);
    EXPECT_LT(m.grains.position[0].x, m.grains.position[1].x) << speed << " m/s each";
    EXPECT_LT(m.grains.velocity[0].x, 0.0);
    EXPECT_EQ(m.hits, 1);
    EXPECT_EQ(m.momentum_error, Vec3{}) << "equal grains, opposite bits";
    EXPECT_LE(m.energy_excess, m.bound) << "J at " << speed << " m/s";
    // From outside the core, 0.5 r deep, a step of at most half a radius each way: r deeper.
    EXPECT_LE(m.deepest, 1.5);
    const Meeting through = meet(speed, 0.0, false);
    EXPECT_GT(through.grains.position[0].x, through.grains.position[1].x) << "the spring alone lets them through";
  }
}

TEST(HardCore, SlowGrains_FeelNothingOfIt) {
  // v (m/2k)^(1/2)/r = 0.43 at 500 m/s: the spring stops them before the core begins.
  const Meeting with = meet(250.0, 0.3 * radius, true), without = meet(250.0, 0.3 * radius, false);
  EXPECT_EQ(with.hits, 0);
  EXPECT_EQ(with.grains.position, without.grains.position);
  EXPECT_EQ(with.grains.velocity, without.grains.velocity);
}

TEST(HardCoreImpulse, AnyPair_KeepsEnergyAndOnlyPushes) {
  // An expression of about 30 operations on numbers of size 1: 30 eps = 7e-15; 1e-13 leaves room for cancellation.
  for (std::uint32_t n = 0; n < 500; ++n) {
    CounterRandom random(3, RandomUse::test, n);
    const auto about = [&] { return 2.0 * random.uniform() - 1.0; };
    const Vec3 d{about(), about(), about()}, v{about(), about(), about()};
    const double a = 0.1 + random.uniform(), b = 0.1 + random.uniform(), inverse = 1.0 / a + 1.0 / b;
    const Vec3 impulse = hard_core_impulse(d, v, inverse);
    EXPECT_GE(dot(impulse, d), 0.0);
    EXPECT_EQ(impulse == Vec3{}, dot(d, v) >= 0.0);
    EXPECT_NEAR(squared_norm(v + impulse * inverse), squared_norm(v), 1e-13) << "pair " << n;
  }
}

/// A ball of grains with two of different size that collapses onto itself between mirrors.
struct Crush {
  Crush(int threads, bool core) : pairs({{stiffness, 0.0, 0.0}, {true}, {}, 0.0, threads}) {
    std::vector<Vec3> places;
    for (int x = 0; x < 14; ++x)
      for (int y = 0; y < 14; ++y)
        for (int z = 0; z < 14; ++z) places.push_back({2.1e-3 * (x + 1), 2.1e-3 * (y + 1), 2.1e-3 * (z - 7)});
    sand = make_grains(places, 1e-3, 1e-5);
    for (std::size_t i = 0; i < sand.size(); ++i) {
      sand.grain_radius.push_back(i % 3 ? 1e-3 : 0.9e-3), sand.grain_mass.push_back(i % 3 ? 1e-5 : 0.73e-5);
      CounterRandom random(3, RandomUse::test, static_cast<std::uint32_t>(i));
      const double x = random.normal(), y = random.normal(), z = random.normal();
      sand.velocity[i] = sand.position[i] * -8e4 + Vec3{x, y, z} * 400.0;
    }
    before = kinetic_energy(sand), start = momentum(sand);
    pairs.forces(sand, 0.0);
    for (int n = 0; n < 60; ++n) {
      sand_step(sand, pairs, std::min(pairs.stable_step(), HardCore::longest_step(sand)), threads);
      if (!core) continue;
      const HardCoreCounts now = hard_core.run(sand, pairs);
      hits += now.hits, mirrors += now.mirror_impulse;
    }
    for (std::size_t i = 0; i < sand.size(); ++i) hash.add(sand.position[i]), hash.add(sand.velocity[i]);
  }
  SandState sand;
  SandPairs pairs;
  HardCore hard_core;
  double before = 0.0;
  Vec3 start, mirrors;
  long hits = 0;
  StateHash hash;
};

TEST(HardCore, BallThatCollapsesBetweenMirrors_KeepsMomentumAndEnergyWithAnyThreads) {
  const Crush one(1, true), three(3, true), none(1, false);
  EXPECT_GT(one.hits, 100);
  EXPECT_EQ(one.hash.value(), three.hash.value());
  EXPECT_LT(one.pairs.books().max_overlap_over_radius, 1.5);
  EXPECT_GT(none.pairs.books().max_overlap_over_radius, one.pairs.books().max_overlap_over_radius);
  // Rounding of about 60 steps and as many impulses on 2744 grains of |m v| = 2e-2 kg m/s: a random walk of 4e5
  // roundings is 6e2 eps 2e-2 = 3e-15; a factor 100 for what the sum adds.
  const Vec3 error = momentum(one.sand) + one.pairs.books().mirror_impulse + one.mirrors - one.start;
  EXPECT_NEAR(norm(error), 0.0, 3e-13);
  const double now = kinetic_energy(one.sand) + one.pairs.books().elastic_energy;
  // The same spring, without the core, enters its contacts within steps too: 0.5 %, see particles_sand_books_test.cpp.
  EXPECT_NEAR(now / one.before, 1.0, 0.005);
}

}  // namespace
}  // namespace standoff::particles
