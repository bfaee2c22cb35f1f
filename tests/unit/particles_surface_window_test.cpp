// Laws of a window: the load handed over is impulse / window; the wall answers its own hits at once; the structure's
// next motion replaces that answer, except, in the parallel scheme, the part the structure has not been told of yet.
// What hits the rigid surround loads no node of the plate. Tolerance: one or two roundings.
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "particle_solver/state/surface_sheet.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

constexpr double window = 2e-7;

/// Impulse of 1e-3 N s downwards at node 12, the middle of a 4 x 4 mesh of nodes of 1 g.
void strike(SurfaceSheet& sheet) {
  sheet.push(sheet.closest({0.0, 0.0, 0.01}, 0.1), {0.0, 0.0, -1e-3}, 0.0);
}

TEST(Window_AfterAHit, HandsOverItsImpulseOnceAsAForce) {
  SurfaceSheet sheet(flat_mesh(4, 0.2, 1e-3), {});
  strike(sheet);
  SurfaceLoad load;
  sheet.collect_load(window, load);
  EXPECT_NEAR(load.force[12].z, -1e-3 / window, 1e-10);
  EXPECT_EQ(load.force[11], Vec3{});
  sheet.collect_load(window, load);
  EXPECT_EQ(load.force[12], Vec3{});
  EXPECT_NEAR(sheet.node_impulse()[12].z, -1e-3, 1e-18) << "the map keeps the sum";
}

TEST(Window_InTheSerialScheme, TakesTheMotionAsItIs) {
  const SurfaceMesh mesh = flat_mesh(4, 0.2, 1e-3);
  SurfaceSheet sheet(mesh, {});
  strike(sheet);
  EXPECT_NEAR(sheet.node_velocity()[12].z, -1.0, 1e-15) << "answers at once";
  SurfaceLoad load;
  sheet.collect_load(window, load);
  SurfaceMotion motion = at_rest(mesh);
  motion.velocity[12].z = -0.9;
  sheet.begin_window(motion, false);
  EXPECT_EQ(sheet.node_velocity()[12].z, -0.9);
}

TEST(Window_InTheParallelScheme, KeepsOnlyTheLastWindowsAnswer) {
  const SurfaceMesh mesh = flat_mesh(4, 0.2, 1e-3);
  SurfaceSheet sheet(mesh, {});
  SurfaceLoad load;
  sheet.begin_window(at_rest(mesh), true);
  strike(sheet);
  sheet.collect_load(window, load);
  sheet.begin_window(at_rest(mesh), true);  // the structure did not know of the hit when it computed this
  EXPECT_NEAR(sheet.node_velocity()[12].z, -1.0, 1e-15);
  strike(sheet), strike(sheet);
  EXPECT_NEAR(sheet.node_velocity()[12].z, -3.0, 1e-15) << "own answer on top";
  sheet.collect_load(window, load);
  EXPECT_NEAR(load.force[12].z, -2e-3 / window, 1e-10) << "the kept answer is not sent again";
  SurfaceMotion motion = at_rest(mesh);
  motion.velocity[12].z = -1.0;  // now it contains the first
  sheet.begin_window(motion, true);
  EXPECT_NEAR(sheet.node_velocity()[12].z, -3.0, 1e-15);
  sheet.collect_load(window, load);
  motion.velocity[12].z = -3.0;
  sheet.begin_window(motion, true);
  EXPECT_EQ(sheet.node_velocity()[12].z, -3.0) << "nothing pending";
}

TEST(Window_WithAMotionOfTheWrongSize, IsRefused) {
  SurfaceSheet sheet(flat_mesh(4, 0.2, 1e-3), {false, 0.3});
  SurfaceMotion motion = at_rest(flat_mesh(3, 0.2, 1e-3));
  EXPECT_THROW(sheet.begin_window(motion, false), Stop);
}

TEST(Ring_AroundThePlate, TakesItsImpulseAloneAndDoesNotMove) {
  SurfaceSheet sheet(flat_mesh(4, 0.2, 1e-3), {false, 0.3});
  EXPECT_EQ(sheet.plate_nodes(), 25u);
  EXPECT_EQ(sheet.mesh().quads.size(), 16u + 16u);
  Vec3 v{10.0, 0.0, -100.0};
  const SheetPoint where = sheet.closest({0.2 + 1e-8, 0.03, 0.001}, 0.01);
  EXPECT_TRUE(where.rigid);
  EXPECT_EQ(where.inverse_mass, 0.0);
  const Impact hit = sheet.collide(where, 1e-4, 1.0, 0.0, 0.0, v);
  EXPECT_NEAR(v.z, 100.0, 1e-12);
  EXPECT_NEAR(hit.impulse.z, -0.02, 1e-16);
  EXPECT_EQ(hit.work, 0.0);
  EXPECT_EQ(sheet.surround_impulse(), hit.impulse);
  EXPECT_EQ(sheet.total_impulse(), Vec3{});
  for (const Vec3& u : sheet.node_velocity()) EXPECT_EQ(u, Vec3{});
  EXPECT_FALSE(sheet.closest({0.2 - 1e-8, 0.03, 0.001}, 0.01).rigid);
}

TEST(Ring_OfFullAndQuarterModel, CoversTheCoverPlateWithoutHoles) {
  const SurfaceMesh quarter = sheet_mesh(4, 0.0, 0.2, 1e-3, [](double x, double y) { return Vec3{x, y, 0.0}; });
  const SurfaceSheet whole(flat_mesh(8, 0.2, 1e-3), {false, 0.3}), part(quarter, {true, 0.3});
  CounterRandom random(4, RandomUse::test, 1);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p{between(random, -0.3, 0.3), between(random, -0.3, 0.3), 0.002};
    const bool outside = std::max(std::abs(p.x), std::abs(p.y)) > 0.2;
    const SheetPoint a = whole.closest(p, 0.01), b = part.closest({std::abs(p.x), std::abs(p.y), p.z}, 0.01);
    ASSERT_NEAR(a.gap, 0.002, 1e-15) << p.x << ' ' << p.y;
    ASSERT_NEAR(b.gap, 0.002, 1e-15) << p.x << ' ' << p.y;
    EXPECT_EQ(a.rigid, outside);
    EXPECT_EQ(b.rigid, outside);
  }
  EXPECT_EQ(part.mesh().quads.size(), 16u + 8u) << "an L: the mirror edges get no ring";
}

TEST(Ring_SmallerThanThePlate, IsRefused) {
  EXPECT_THROW(SurfaceSheet(flat_mesh(4, 0.2, 1e-3), {false, 0.15}), Stop);
}

}  // namespace
}  // namespace standoff::particles
