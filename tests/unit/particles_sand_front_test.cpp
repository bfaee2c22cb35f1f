// The front of the sand: 99 % of the grains that are in the scene lie within it, however many have left. Exact.
#include <cmath>

#include <gtest/gtest.h>

#include "particle_solver/scene/sand_front.hpp"

namespace standoff::particles {
namespace {

/// Grains at 1, 2, 3 ... m from `centre`, the far ones first.
SandState in_a_row(int count, const Vec3& centre) {
  SandState sand;
  for (int n = count; n > 0; --n) sand.position.push_back(centre + Vec3{0.0, 0.0, 1.0 * n});
  return sand;
}

TEST(SandFront, HoldsNinetyNinePercentOfWhatIsLeft) {
  const Vec3 centre{0.0, 0.0, 2.0};
  EXPECT_EQ(sand_front_radius(in_a_row(200, centre), centre), 198.0);
  EXPECT_EQ(sand_front_radius(in_a_row(190, centre), centre), 189.0) << "a twentieth has left, the far ones";
  EXPECT_EQ(sand_front_radius(in_a_row(1, centre), centre), 1.0);
}

TEST(SandFront, OfNoGrains_IsNoNumber) {
  EXPECT_TRUE(std::isnan(sand_front_radius({}, {})));
}

}  // namespace
}  // namespace standoff::particles
