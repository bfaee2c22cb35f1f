// Many grains: what must hold whatever they do. Momentum is exact up to rounding because each pair's forces are
// opposite bits; energy is exact up to the steps in which contacts begin and end: each shifts at most k (v dt)^2/8 of
// either sign, at the recommended step 0.25 % of the energy of that impact; over many impacts the signs cancel, so 0.5
// % bounds the sum even if every grain is hit twice with all shifts of one sign.
#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/state_hash.hpp"
#include "particle_solver/packing/packed_cell.hpp"
#include "particle_solver/step/sand_integrate.hpp"
#include "tests/unit/particles_sand_clouds.hpp"

namespace standoff::particles {
namespace {

using test::two_clouds;

constexpr double stiffness = 1e7, mass = 1e-5;

struct Outcome {
  double energy_error, losses;
  Vec3 momentum_error;
  std::uint64_t hash;
  SandBooks books;
};

Outcome crash(const GrainLaw& law, bool radii, int threads, int steps = 400) {
  SandState sand = two_clouds(radii);
  SandPairs pairs({law, {}, {}, 0.0, threads});
  const double energy = kinetic_energy(sand);
  const Vec3 start = momentum(sand);
  pairs.forces(sand, 0.0);
  for (int n = 0; n < steps; ++n) sand_step(sand, pairs, pairs.stable_step(), threads);
  const SandBooks& b = pairs.books();
  const double now = kinetic_energy(sand) + b.elastic_energy + b.friction_loss + b.damping_loss;
  StateHash hash;
  for (std::size_t i = 0; i < sand.size(); ++i) hash.add(sand.position[i]), hash.add(sand.velocity[i]);
  hash.add(b.friction_loss), hash.add(b.damping_loss);
  return {now / energy - 1.0, (b.friction_loss + b.damping_loss) / energy, momentum(sand) - start, hash.value(), b};
}

TEST(SandBooks, CloudsCollideAt600MetresPerSecond_EnergyClosesWithinHalfAPercent) {
  for (const auto& [law, radii] : {std::pair{GrainLaw{stiffness, 0.3, 0.0}, false},
                                   {{stiffness, 0.0, 0.05}, true},
                                   {{stiffness, 0.2, 0.05}, true},
                                   {{stiffness, 0.0, 0.0}, false}}) {
    const Outcome o = crash(law, radii, 1);
    EXPECT_NEAR(o.energy_error, 0.0, 0.005) << "mu " << law.friction << ", xi " << law.damping;
    EXPECT_EQ(o.books.friction_loss > 0.0, law.friction > 0.0);
    EXPECT_EQ(o.books.damping_loss > 0.0, law.damping > 0.0);
    if (law.friction > 0.0) {
      EXPECT_GT(o.losses, 0.1) << "the clouds must really meet";
    }
    EXPECT_GT(o.books.max_overlap_over_radius, 0.05);
  }
}

TEST(SandBooks, CloudsCollide_MomentumIsKeptToRounding) {
  // 400 steps, two kicks each, of 2000 grains with |m v| = 3e-3: rounding grows as a random walk, sqrt(1.6e6) eps 3e-3
  // = 8e-16, and a factor 100 for what a sum of 2000 numbers adds.
  const Outcome o = crash({stiffness, 0.3, 0.0}, false, 1);
  EXPECT_NEAR(norm(o.momentum_error), 0.0, 1e-13);
}

TEST(SandBooks, OneTwoOrThreeThreads_GiveTheSameBits) {
  for (const bool radii : {false, true}) {
    const GrainLaw law{stiffness, 0.3, 0.02};
    const std::uint64_t one = crash(law, radii, 1, 40).hash;
    EXPECT_EQ(crash(law, radii, 2, 40).hash, one);
    EXPECT_EQ(crash(law, radii, 3, 40).hash, one);
  }
}

TEST(SandForces, RandomOverlappingCloud_SumToZeroAndMatchABruteForceSum) {
  // Reference: all pairs, no lists. Sums of up to 40 forces in another order differ by 40 eps of the largest; 1e-12 is
  // ample.
  CounterRandom random(5, RandomUse::test, 0);
  std::vector<Vec3> places(700);
  for (Vec3& p : places) p.x = random.uniform(), p.y = random.uniform(), p.z = 0.3 * random.uniform();
  SandState sand = make_grains(places, 0.05, 1.0);
  SandPairs pairs({{1.0, 0.0, 0.0}, {}, {}, 0.0, 2});
  pairs.forces(sand, 0.0);
  Vec3 sum;
  double elastic = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Vec3 expected;
    for (std::size_t j = 0; j < places.size(); ++j) {
      const Vec3 d = places[i] - places[j];
      const double distance = norm(d);
      if (i == j || distance >= 0.1) continue;
      expected += ((0.1 - distance) / distance) * d;
      elastic += 0.25 * (0.1 - distance) * (0.1 - distance);
    }
    EXPECT_NEAR(norm(sand.force[i] - expected), 0.0, 1e-12) << "grain " << i;
    sum += sand.force[i];
  }
  EXPECT_NEAR(norm(sum), 0.0, 1e-12);
  EXPECT_NEAR(pairs.books().elastic_energy, elastic, 1e-12);
}

TEST(SandForces, ThreeGrainsInARow_ChainPassesMomentumOn) {
  // Newton's cradle: 0 hits 1 and 2 (apart by a gap). Equal masses swap speeds; each hit is exact to (w0 dt)^2/4 = 0.5
  // %.
  SandState sand = make_grains({{0, 0, 0}, {2.2e-3, 0, 0}, {4.6e-3, 0, 0}}, 1e-3, mass);
  sand.velocity[0] = {100, 0, 0};
  SandPairs pairs({{stiffness, 0.3, 0.0}, {}, {}, 0.0, 1});
  pairs.forces(sand, 0.0);
  for (int n = 0; n < 400; ++n) sand_step(sand, pairs, pairs.stable_step());
  EXPECT_NEAR(sand.velocity[2].x, 100.0, 1.0);
  EXPECT_NEAR(sand.velocity[0].x, 0.0, 1.0);
  EXPECT_NEAR(sand.velocity[0].x + sand.velocity[1].x + sand.velocity[2].x, 100.0, 1e-11);
}

}  // namespace
}  // namespace standoff::particles
