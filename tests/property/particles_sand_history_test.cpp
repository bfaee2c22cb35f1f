// Springs between grains survive everything that happens to lists and arrays. Grains in the rows used here have at most
// two contacts: a sum of two forces does not depend on order, so the same physics must give the same bits.
#include <algorithm>

#include <gtest/gtest.h>

#include "particle_solver/packing/packed_cell.hpp"
#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles {
namespace {

constexpr double radius = 1e-3, mass = 1e-5;
constexpr GrainLaw law{1e7, 0.5, 0.02};

/// Pressed rows of three grains, slowly sheared: contacts stay closed while the grains drift a few radii.
SandState rows(int count) {
  std::vector<Vec3> places;
  for (int r = 0; r < count; ++r)
    for (int i = 0; i < 3; ++i) places.push_back({1.98e-3 * i, 5e-3 * (r % 7), 5e-3 * (r / 7)});
  SandState sand = make_grains(places, radius, mass);
  for (std::size_t i = 0; i < sand.size(); ++i)
    sand.velocity[i] = {i % 3 == 0 ? 20.0 : i % 3 == 2 ? -20.0 : 0.0, 30.0 * static_cast<double>(i % 3), 8.0};
  return sand;
}

void run(SandState& sand, SandPairs& pairs, int steps) {
  for (int n = 0; n < steps; ++n) sand_step(sand, pairs, 1e-7);
}

TEST(SandHistory, ThinOrThickSkin_GivesTheSameBits) {
  std::vector<SandState> ends;
  std::vector<long> builds;
  for (const double skin : {0.002, 0.3}) {
    SandState sand = rows(20);
    SandPairs pairs({law, {}, {}, skin, 2});
    pairs.forces(sand, 0.0);
    run(sand, pairs, 120);
    builds.push_back(pairs.books().list_builds);
    EXPECT_GT(pairs.books().friction_loss, 0.0);
    ends.push_back(sand);
  }
  EXPECT_GT(builds[0], 10 * builds[1]) << "the thin skin must really make lists often";
  EXPECT_EQ(ends[0].position, ends[1].position);
  EXPECT_EQ(ends[0].velocity, ends[1].velocity);
}

TEST(SandHistory, ArraysShuffledBetweenSteps_GivesTheSameBits) {
  SandState plain = rows(20), shuffled = rows(20);
  SandPairs a({law, {}, {}, 0.1, 1}), b({law, {}, {}, 0.1, 1});
  a.forces(plain, 0.0), b.forces(shuffled, 0.0);
  for (int n = 0; n < 60; ++n) {
    run(plain, a, 1), run(shuffled, b, 1);
    const auto turn = [n](auto& array) { std::rotate(array.begin(), array.begin() + 1 + n % 5, array.end()); };
    turn(shuffled.position), turn(shuffled.velocity), turn(shuffled.force), turn(shuffled.id);
  }
  for (std::size_t i = 0; i < shuffled.size(); ++i) {
    EXPECT_EQ(shuffled.position[i], plain.position[shuffled.id[i]]);
    EXPECT_EQ(shuffled.velocity[i], plain.velocity[shuffled.id[i]]);
  }
}

TEST(SandHistory, GrainsRemoved_OthersGoOnUntouchedAndTheirEnergyIsBooked) {
  SandState all = rows(20), some = rows(20);
  SandPairs a({law, {}, {}, 0.1, 1}), b({law, {}, {}, 0.1, 1});
  a.forces(all, 0.0), b.forces(some, 0.0);
  run(all, a, 20), run(some, b, 20);
  const double lost = b.books().friction_loss;
  const auto cut = [](auto& array) { array.erase(array.begin() + 30, array.begin() + 31); };  // the first of a row
  cut(some.position), cut(some.velocity), cut(some.force), cut(some.id);
  b.forces(some, 0.0);
  EXPECT_GT(b.books().friction_loss, lost) << "the springs of a removed grain are gone: friction loss";
  a.forces(all, 0.0);
  run(all, a, 20), run(some, b, 20);
  for (std::size_t i = 0; i < some.size(); ++i) {
    if (some.id[i] / 3 == 10) continue;  // the row that lost a grain
    EXPECT_EQ(some.position[i], all.position[some.id[i]]);
  }
}

TEST(SandHistory, SavedAndRestored_GoesOnWithTheSameBits) {
  const PackedCell& cell = pack_cell({500, 0.6, 0.0, 2});
  std::vector<Vec3> places;
  for (const Vec3& p : cell.position) places.push_back(0.02 * p);
  SandState through = make_grains(places, 0.02 * cell.mean_radius, mass);
  for (std::size_t i = 0; i < through.size(); ++i) through.velocity[i] = -4e4 * through.position[i];
  SandPairs whole({law, {true}, {}, 0.0, 1});
  whole.forces(through, 0.0);
  run(through, whole, 77);
  SandState resumed = through;
  SandPairs second({law, {true}, {}, 0.0, 1});
  second.restore(resumed, whole.memory(through));
  run(through, whole, 60), run(resumed, second, 60);
  EXPECT_GT(whole.books().friction_loss, 0.0);
  EXPECT_EQ(resumed.position, through.position);
  EXPECT_EQ(resumed.velocity, through.velocity);
  EXPECT_EQ(second.books().friction_loss, whole.books().friction_loss);
  EXPECT_EQ(second.books().mirror_impulse, whole.books().mirror_impulse);
  EXPECT_EQ(second.books().list_builds, whole.books().list_builds);
}

TEST(SandHistory, WithoutFriction_NoSpringExists) {
  SandState sand = rows(4);
  SandPairs pairs({{1e7, 0.0, 0.01}, {}, {}, 0.1, 1});
  pairs.forces(sand, 0.0);
  run(sand, pairs, 5);
  EXPECT_TRUE(pairs.memory(sand).springs.empty());
}

}  // namespace
}  // namespace standoff::particles
