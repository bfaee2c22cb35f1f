// The unit cell of dry sand whose grains turn. Turning adds freedoms to the same packing, springs and friction, so the
// cell yields at least as much: softer than if grains only translate, and nearer to a fluid (lateral over axial). It
// keeps some of the friction: without any it is softer still. Differences, a tenth and more, are far beyond the 2 % by
// which rearrangements scatter, twice (particles_sand_cell_slow_test.cpp); quasi-static as there.
#include <gtest/gtest.h>

#include "particle_solver/packing/cell_compression.hpp"

namespace standoff::particles {
namespace {

constexpr double scatter = 0.04;

std::vector<CompressionPoint> compressed(double friction, bool turning, int steps = 10000) {
  const PackedCell& cell = pack_cell({1000, 0.60, 0.0, 1});
  return compress_cell(cell, {0.4e9, friction, 0.0}, {0.06, 3, steps, 0.1, 1, turning});
}

TEST(TurningCell, IsSofterThanOneOfGrainsThatDoNotTurn_AndStifferThanWithoutFriction) {
  const auto fixed = compressed(0.3, false), turning = compressed(0.3, true), smooth = compressed(0.0, false);
  for (std::size_t n = 1; n < fixed.size(); ++n) {
    const auto ratio = [&](const auto& curve) { return curve[n].lateral / curve[n].axial; };
    EXPECT_LT(turning[n].axial, (1.0 - scatter) * fixed[n].axial) << "Pa at strain " << fixed[n].strain;
    EXPECT_GT(turning[n].axial, (1.0 + scatter) * smooth[n].axial) << "Pa at strain " << fixed[n].strain;
    EXPECT_GT(ratio(turning), (1.0 + scatter) * ratio(fixed)) << "at strain " << fixed[n].strain;
    EXPECT_LT(ratio(turning), (1.0 - scatter) * ratio(smooth)) << "at strain " << fixed[n].strain;
    EXPECT_GT(turning[n].friction_work, 0.0);
  }
}

TEST(TurningCell, AtHalfTheSpeed_GivesTheSameCurve) {
  const auto fast = compressed(0.3, true), slow = compressed(0.3, true, 20000);
  for (std::size_t n = 1; n < slow.size(); ++n) EXPECT_NEAR(fast[n].axial / slow[n].axial, 1.0, scatter);
}

}  // namespace
}  // namespace standoff::particles
