// Law: a grain feels every grain and every image nearer than the contact distance, and nobody else, also while lists
// made before go on being used across faces. Compared with the search of all pairs, springs of 1 N/m: forces of order
// 1e-2 N are sums of ten numbers that each are right to 1e-16 over the contact distance of 0.04: 1e-13 N.
#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "particle_solver/kernels/periodic_images.hpp"
#include "particle_solver/step/sand_integrate.hpp"
#include "particle_solver/step/sand_pairs.hpp"

namespace standoff::particles {
namespace {

constexpr double radius = 0.02;

SandState cloud(const Vec3& size, int count) {
  CounterRandom random(3, RandomUse::test, 0);
  std::vector<Vec3> at;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    at.push_back({size.x * x, size.y * y, size.z * z});
  }
  SandState sand = make_grains(std::move(at), radius, 1.0);
  for (Vec3& v : sand.velocity) {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    v = {x - 0.5, y - 0.5, z - 0.5};
  }
  return sand;
}

double worst_force(const SandState& sand, const Period& period) {
  double worst = 0.0;
  for (std::size_t i = 0; i < sand.size(); ++i) {
    Vec3 force;
    for (std::size_t j = 0; j < sand.size(); ++j) {
      const Vec3 d = nearest_image(sand.position[i] - sand.position[j], period);
      if (i != j && squared_norm(d) < 4.0 * radius * radius) force += d * (2.0 * radius / norm(d) - 1.0);
    }
    worst = std::max(worst, norm(force - sand.force[i]));
  }
  return worst;
}

/// A wide scene has whole bricks of cells across its faces, a narrow one does not.
class PeriodicLists : public testing::TestWithParam<Vec3> {};

TEST_P(PeriodicLists, GrainsThatFlyThroughEachOther_FeelEveryImageInReach) {
  const Vec3 size = GetParam();
  const Period period = period_of({size.x, size.y, 0.0});
  SandState sand = cloud(size, 1000);
  SandPairs pairs({{1.0, 0.0, 0.0}, {}, period.length, 0.2, 1});
  for (int step = 0; step < 20; ++step) {
    pairs.forces(sand, step == 0 ? 0.0 : 1.0);
    ASSERT_LT(worst_force(sand, period), 1e-13) << "step " << step;
    for (std::size_t i = 0; i < sand.size(); ++i) sand.position[i] += sand.velocity[i] * 2e-3;
  }
  EXPECT_GT(pairs.books().list_builds, 3);
  EXPECT_LT(pairs.books().list_builds, 15) << "some lists must have been used again";
}
/// Nobody moves against a neighbour but across the face: what only a watch over the faces can tell.
TEST(PeriodicHalves, ThatMeetAcrossAFace_FeelEachOther) {
  const Period period = period_of({1.0, 0.8, 0.0});
  SandState sand = cloud({0.6, 0.8, 0.2}, 600);
  for (std::size_t i = 0; i < sand.size(); ++i) {
    double& x = sand.position[i].x;
    const bool left = x < 0.3;
    x += left ? 0.03 : 0.37;  // [0.03, 0.33] and [0.67, 0.97], 0.06 apart across the face
    sand.velocity[i] = {left ? -1.0 : 1.0, 0.0, 0.0};
  }
  SandPairs pairs({{1.0, 0.0, 0.0}, {}, period.length, 0.2, 1});
  for (int step = 0; step < 20; ++step) {
    pairs.forces(sand, step == 0 ? 0.0 : 1.0);
    ASSERT_LT(worst_force(sand, period), 1e-13) << "step " << step;
    for (std::size_t i = 0; i < sand.size(); ++i) sand.position[i] += sand.velocity[i] * 2e-3;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PeriodicLists, testing::Values(Vec3{1.0, 0.8, 0.2}, Vec3{0.45, 0.4, 0.4}));

}  // namespace
}  // namespace standoff::particles
