// Law: what leaves through a face comes in opposite. So the path of gas and air is followed there where it may meet the
// sheet, nobody is taken out, and air knows no edge: cells wake across the faces, and ambient air flows in from above
// and below alone. A wall that does not give way turns a velocity round exactly: 1e-14 of 2 m/s, some 20 roundings.
#include <gtest/gtest.h>

#include "tests/unit/particles_periodic_scenes.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace standoff::particles::test;

/// A wall that does not give way and ends at the faces: what flies out over it meets the next one.
TEST(PeriodicFaces, GasAndAirThatLeaveWithinAStep_HitTheNextPlate) {
  for (const double x : {0.0, 29.0 / 64}) {
    SurfaceSheet sheet(test::flat_mesh(4, 0.5, 1.0), {.recedes = false});
    const Vec3 at{x, 0.0, 6.0 / 64}, velocity{4, 0, -2};
    const Outcome gas = after_sub_step(spheres({at}, {velocity}), nullptr, &sheet);
    EXPECT_EQ(gas.hits, 1) << "gas from x = " << x;
    EXPECT_NEAR(gas.velocity[0].z, 2.0, 1e-14);
    EXPECT_NEAR(sheet.total_impulse().z, -4.0, 1e-14);
    const auto air = air_in({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 0.125, 2.0});
    static_cast<GasState&>(air->particles) = spheres({at}, {velocity});
    air->particles.disturbed.assign(1, 0), air->particles.plate_rebound.assign(1, 0.0);
    EXPECT_EQ(AirDrift({}, 1, sides).run(*air, nullptr, &sheet, sub_step).sheet_hits, 1) << "air from x = " << x;
  }
}

TEST(PeriodicFaces, BeyondAFace_NobodyIsTakenOut) {
  GasState gas = spheres({{0, 0, 0}, {0, 0, 0}}, {{}, {}});
  gas.position = {{0.5 + 1e-15, -0.5 - 1e-15, 0}, {0, 0, 0.6}};
  BoundaryBooks books;
  Boundaries exits({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, false, 1, false, true});
  EXPECT_EQ(exits.run(&gas, nullptr, nullptr, books).gas, std::vector<std::uint32_t>{1}) << "above the open end";
}

TEST(PeriodicFaces, DisturbedAtAFace_WakesAcrossItAndNothingFlowsInThere) {
  AirCells cells({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, 0.125, 0.0, 0.0, false, false, true});
  cells.disturb({0.49, -0.49, 0.1});
  cells.wake();
  EXPECT_EQ(cells.state_at({-0.49, 0.49, 0.1}), AirCell::awake) << "behind the edge";
  EXPECT_EQ(cells.state_at({-0.3, 0.3, 0.1}), AirCell::asleep);
  cells.wake_all();
  cells.wake();
  EXPECT_EQ(cells.sources().size(), 2u * 8 * 8) << "top and bottom";
  for (const AirSource& source : cells.sources()) EXPECT_EQ(source.axis, 2);
}

}  // namespace
}  // namespace standoff::particles
