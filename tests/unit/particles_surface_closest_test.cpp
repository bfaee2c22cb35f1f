// Law: the contact is the globally closest point of the whole sheet, with the signed distance to it; on a plane that is
// the distance to the plane whatever its quads. Tolerance: coordinates of 0.3 m carry 5.5e-17 m; over the 1 mm gaps
// here that is 1e-13 in a direction, and a few roundings of 1e-16 m in a gap.
#include <numbers>

#include <gtest/gtest.h>

#include "particle_solver/state/surface_sheet.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

/// A plane through the origin, tilted about y, of irregular quads.
SurfaceMesh tilted_plane(CounterRandom& random, double tilt) {
  const double h = 0.6 / 20;
  return sheet_mesh(20, -0.3, 0.3, 1.0, [&](double x, double y) {
    const double u = x + between(random, -0.3 * h, 0.3 * h), v = y + between(random, -0.3 * h, 0.3 * h);
    return Vec3{u * std::cos(tilt), v, u * std::sin(tilt)};
  });
}

TEST(ClosestPoint_OnARandomMeshOfAPlane, IsThatOfThePlane) {
  CounterRandom random(2, RandomUse::test, 1);
  for (const double tilt : {0.0, 0.5, std::numbers::pi / 3}) {
    const SurfaceSheet sheet(tilted_plane(random, tilt), {});
    const Vec3 n{-std::sin(tilt), 0.0, std::cos(tilt)};
    for (int i = 0; i < 3000; ++i) {
      const double u = between(random, -0.28, 0.28), v = between(random, -0.28, 0.28),
                   gap = between(random, -1e-3, 2e-3);
      const Vec3 foot{u * std::cos(tilt), v, u * std::sin(tilt)};
      const SheetPoint where = sheet.closest(foot + n * gap, 2.1e-3);
      ASSERT_GE(where.face, 0) << "tilt " << tilt << " at " << u << ' ' << v << " gap " << gap;
      EXPECT_NEAR(where.gap, gap, 2e-15) << "m";
      EXPECT_LT(norm(where.normal - n), 1e-12);
      EXPECT_LT(norm(where.point - foot), 1e-14) << "m";
    }
  }
}

/// The closest point by looking at every face: no bins, no pruning.
double distance_to_all(const SurfaceMesh& mesh, const Vec3& p) {
  double best = 1e300;
  for (const auto& quad : mesh.quads) {
    std::array<Vec3, 4> x;
    for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.position[static_cast<std::size_t>(quad[i])];
    best = std::min(best, quad_foot(x, p).squared_distance);
  }
  return std::sqrt(best);
}

/// Corrugated: ridges and valleys with flanks at 60 degrees.
Vec3 folded(double x, double y) {
  const double period = 0.12, u = std::abs(std::remainder(x, period));
  return {x, y, std::tan(std::numbers::pi / 3) * u};
}

TEST(ClosestPoint_OnASheetFoldedToSixtyDegrees, IsTheGloballyClosestWithTheRightSide) {
  const SurfaceMesh mesh = sheet_mesh(20, -0.3, 0.3, 1.0, folded);
  const SurfaceSheet sheet(mesh, {});
  CounterRandom random(2, RandomUse::test, 2);
  int checked = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = between(random, -0.25, 0.25), y = between(random, -0.25, 0.25);
    const double above = between(random, -0.01, 0.03);
    const Vec3 p = folded(x, y) + Vec3{0, 0, above};  // vertically above a height field means in front of it
    const SheetPoint where = sheet.closest(p, 0.02);
    const double distance = distance_to_all(mesh, p);
    if (distance > 0.02 * (1 - 1e-12)) {
      EXPECT_EQ(where.face, -1);
      continue;
    }
    ASSERT_GE(where.face, 0);
    EXPECT_NEAR(std::abs(where.gap), distance, 1e-15);
    EXPECT_EQ(where.gap > 0, above > 0) << "at " << p.x << ' ' << p.y << ' ' << p.z;
    ++checked;
  }
  EXPECT_GT(checked, 10000);
}

TEST(ClosestPoint_AboveARidge, HasTheNormalFromTheRidgeToThePosition) {
  const SurfaceSheet sheet(sheet_mesh(20, -0.3, 0.3, 1.0,
                                      [](double x, double y) {
                                        return Vec3{x, y, -std::abs(x)};
                                      }),
                           {});
  for (const double slope : {-0.5, 0.0, 0.9}) {  // tangent of the angle to the vertical; the flanks' normals are at 1
    const Vec3 offset = Vec3{slope, 0.0, 1.0} * 1e-3;
    const SheetPoint where = sheet.closest(Vec3{0.0, 0.01, 0.0} + offset, 0.01);
    EXPECT_NEAR(where.gap, norm(offset), 1e-15) << "m";
    EXPECT_LT(norm(where.normal - offset / norm(offset)), 1e-12);
  }
  EXPECT_LT(norm(sheet.closest({0.0, 0.01, -1e-3}, 0.01).normal - Vec3{0, 0, 1}), 1.0)
      << "sunk in: pushed to the front";
}

TEST(ClosestPoint_AboveASeamOfAPlane, GoesToTheLowestFace) {
  const SurfaceSheet sheet(flat_mesh(4, 2.0, 1.0), {});
  EXPECT_EQ(sheet.closest({0.0, 0.5, 0.1}, 0.2).face, 9);   // between 9 and 10
  EXPECT_EQ(sheet.closest({0.0, 0.0, 0.1}, 0.2).face, 5);   // corner of 5, 6, 9, 10
  EXPECT_EQ(sheet.closest({1.0, -1.0, 0.1}, 0.2).face, 2);  // corner of 2, 3, 6, 7
}

TEST(ClosestPoint_WhileTheSheetMoves, IsThatOfTheMovedSheet) {
  const SurfaceMesh mesh = sheet_mesh(20, -0.3, 0.3, 1.0, folded);
  SurfaceSheet sheet(mesh, {});
  CounterRandom random(2, RandomUse::test, 3);
  SurfaceMotion motion = at_rest(mesh);
  for (Vec3& v : motion.velocity) v = Vec3{20.0, -10.0, -100.0} + random_vector(random, 30.0);
  sheet.begin_window(motion, false);
  double time = 0.0;
  for (int step = 0; step < 50; ++step, time += 2e-6, sheet.drift(2e-6)) {  // 10 mm in all, a third of a quad
    SurfaceMesh moved = mesh;
    for (std::size_t n = 0; n < moved.position.size(); ++n) moved.position[n] += motion.velocity[n] * (time + 1e-6);
    for (int i = 0; i < 20; ++i) {
      const double x = between(random, -0.2, 0.2);
      const Vec3 p = folded(x, 0.01 * i) + Vec3{0, 0, between(random, -0.01, 0.02)};
      const double distance = distance_to_all(moved, p);
      const SheetPoint where = sheet.closest(p, 0.03, 1e-6);
      ASSERT_GE(where.face, 0);
      EXPECT_NEAR(std::abs(where.gap), distance, 1e-15);
    }
  }
}

TEST(ClosestPoint_BesideAnOpenEdge, IsAContactOnlyFromTheFront) {
  const SurfaceSheet sheet(flat_mesh(4, 2.0, 1.0), {});
  EXPECT_NEAR(sheet.closest({2.03, 0.1, 0.04}, 0.2).gap, 0.05, 1e-15);
  EXPECT_EQ(sheet.closest({2.03, 0.1, -0.04}, 0.2).face, -1);
  EXPECT_EQ(sheet.closest({2.03, 2.03, -0.04}, 0.2).face, -1);
  EXPECT_NEAR(sheet.closest({1.97, 0.1, -0.04}, 0.2).gap, -0.04, 1e-15);  // under the sheet: it has sunk in
}

}  // namespace
}  // namespace standoff::particles
