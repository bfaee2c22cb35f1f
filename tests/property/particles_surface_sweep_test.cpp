// Law: a sphere on a straight path touches the moving sheet first at the first zero of gap - radius; on a plane that
// moves as a whole the time is (gap - radius) / closing speed. Nothing passes through, whatever the step. Tolerances:
// the sweep calls a sphere touching from 1e-9 radius on, so times on a plane agree within 1e-9 radius over the closing
// speed; on other surfaces a path may graze the sheet, leaving by itself, without a hit (surface_sweep.hpp).
#include <gtest/gtest.h>

#include "particle_solver/kernels/surface_sweep.hpp"
#include "particle_solver/state/surface_sheet.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

constexpr double radius = 0.4e-3;

TEST(FirstHit_OnAMovingPlane, IsAtTheAnalyticTimeForAnyStep) {
  const SurfaceMesh mesh = flat_mesh(40, 0.2, 1e-3);
  SurfaceSheet sheet(mesh, {});
  CounterRandom random(5, RandomUse::test, 1);
  for (int i = 0; i < 4000; ++i) {
    SurfaceMotion motion = at_rest(mesh);
    const Vec3 wall{0.0, 0.0, between(random, -400.0, 400.0)};
    for (Vec3& v : motion.velocity) v = wall;
    if (i % 50 == 0) sheet.begin_window(motion, false);
    const double wall_speed = sheet.node_velocity()[0].z, step = std::pow(10.0, between(random, -8.0, -5.0));
    const Vec3 x{between(random, -0.05, 0.05), between(random, -0.05, 0.05), radius + between(random, 0.0, 0.05)};
    const Vec3 v{between(random, -8000.0, 8000.0), between(random, -3000.0, 3000.0), between(random, -12000.0, 2000.0)};
    const double exact = (x.z - radius) / (wall_speed - v.z);
    double t = -1.0;
    SheetPoint where;
    const bool hit = sheet.first_hit(x, v, radius, 0.0, step, t, where);
    if (std::abs(exact - step) < 1e-9 * step) continue;
    ASSERT_EQ(hit, exact >= 0.0 && exact < step) << "exact " << exact << " s, step " << step << " s";
    if (!hit) continue;
    EXPECT_NEAR(t, exact, 2e-9 * radius / (wall_speed - v.z) + 1e-16 * 0.3 / (wall_speed - v.z));
    EXPECT_NEAR(where.gap, radius, 2e-9 * radius);
    EXPECT_NEAR(where.point.x, x.x + v.x * t, 1e-12);
  }
}

TEST(FirstHit_OfASphereAlreadyTouching, FiresAtOnceIfItApproaches) {
  const SurfaceSheet sheet(flat_mesh(40, 0.2, 1e-3), {});
  double t = -1.0;
  SheetPoint where;
  EXPECT_TRUE(sheet.first_hit({0.01, 0, 0.9 * radius}, {50, 0, -1}, radius, 3e-8, 1e-6, t, where));
  EXPECT_EQ(t, 3e-8);
  EXPECT_TRUE(sheet.first_hit({0.01, 0, -0.5 * radius}, {50, 0, -1}, radius, 0.0, 1e-6, t, where)) << "sunk in";
  EXPECT_FALSE(sheet.first_hit({0.01, 0, 0.9 * radius}, {50, 0, 1}, radius, 0.0, 1e-6, t, where)) << "leaving";
  EXPECT_FALSE(sheet.first_hit({0.01, 0, -1.5 * radius}, {5000, 0, -1}, radius, 0.0, 1e-6, t, where)) << "behind";
  EXPECT_FALSE(sheet.first_hit({0.01, 0, radius}, {50, 0, 0}, radius, 0.0, 1e-6, t, where)) << "sliding along";
}

/// Valleys and ridges of 60 degrees, 30 mm apart.
Vec3 folded(double x, double y) {
  return {x, y, std::sqrt(3.0) * std::abs(std::remainder(x, 0.06))};
}

TEST(FirstHit_AtTwelveKilometresPerSecondIntoAFoldedSheet, LetsNothingThrough) {
  const SurfaceMesh mesh = sheet_mesh(40, -0.3, 0.3, 1e-3, folded);
  SurfaceSheet sheet(mesh, {});
  CounterRandom random(5, RandomUse::test, 2);
  SurfaceMotion motion = at_rest(mesh);
  for (Vec3& v : motion.velocity) v = Vec3{0, 0, -100} + random_vector(random, 200.0);
  sheet.begin_window(motion, false);
  int hits = 0, rounds = 0;
  for (int i = 0; i < 3000; ++i) {
    const double step = std::pow(10.0, between(random, -8.0, -5.3));
    const Vec3 x = Vec3{between(random, -0.2, 0.2), between(random, -0.2, 0.2), 0.0};
    const Vec3 start = x + Vec3{0, 0, folded(x.x, x.y).z + between(random, 2.2, 20.0) * radius};  // clear of the flanks
    Vec3 v = random_vector(random, 1.0);
    v.z = -std::abs(v.z);
    v *= 12000.0 / norm(v);
    double t = 0.0;
    SheetPoint where;
    Vec3 place = start;  // starting point, shifted back at each elastic hit on the sheet taken as infinitely heavy
    bool again = true;
    for (int n = 0; again && n < 40; ++n, ++rounds) {
      again = sheet.first_hit(place, v, radius, t, step, t, where);
      if (!again) break;
      ++hits;
      // The first touch is exact; one right after a rebound in the corner of a valley may be found 0.25 radius late.
      ASSERT_GT(where.gap, n == 0 ? (1 - 2e-9) * radius : 0.7 * radius) << "m, rebound " << n;
      const Vec3 change = where.normal * (-2.0 * dot(v - where.velocity, where.normal));
      v += change, place -= change * t;
    }
    ASSERT_FALSE(again) << "still hitting after 40 rebounds in one step";
    const SheetPoint end = sheet.closest(place + v * step, radius, step);
    EXPECT_TRUE(end.face < 0 || end.gap > 0.7 * radius) << "gap " << end.gap << " m after a step of " << step << " s";
    const double height = (place + v * step).z - folded((place + v * step).x, 0.0).z;
    EXPECT_GT(height, -1000.0 * step) << "m, below the sheet";  // flanks move by at most 500 m/s, 60 degrees: factor 2
  }
  EXPECT_GT(hits, 500) << "the paths missed the sheet: the test says nothing";
}

TEST(Sweep_OverAPostStandingOnAPlane, IsNotFooledByTheClearPathBehindIt) {
  // Plane 0.1 below the sphere of radius 1, a thin post under its path at x = 0.6 with its tip 0.95 below the centre:
  // the sphere is clear at both ends of the path and touches at x = 0.6 - sqrt(1 - 0.95^2).
  const auto probe = [](double t) -> Clearance {
    const double distance = std::hypot(0.6 - t, 0.95), post = distance - 1.0;
    return post < 0.1 ? Clearance{post, (t - 0.6) / distance} : Clearance{0.1, 0.0};
  };
  double t = -1.0;
  ASSERT_TRUE(sweep_to_contact({1.0, 1.0, 0.25, 0.0, 1.0}, probe, t));
  EXPECT_NEAR(t, 0.6 - std::sqrt(1.0 - 0.95 * 0.95), 1e-8);
}

TEST(FirstHit_AcrossTheSeamsOfARandomPlane, FindsOneHitAtTheExactTime) {
  CounterRandom random(5, RandomUse::test, 3);
  const double h = 0.005;
  const SurfaceMesh mesh = sheet_mesh(40, -0.1, 0.1, 1e-3, [&](double x, double y) {
    return Vec3{x + between(random, -0.3 * h, 0.3 * h), y + between(random, -0.3 * h, 0.3 * h), 0.0};
  });
  const SurfaceSheet sheet(mesh, {});
  for (int i = 0; i < 3000; ++i) {
    const Vec3 x{between(random, -0.04, 0.04), between(random, -0.04, 0.04), radius * between(random, 1.0, 5.0)};
    const Vec3 v{between(random, -5000.0, 5000.0), 0.0, -between(random, 10.0, 5000.0)};
    const double exact = (x.z - radius) / -v.z, end = std::min(2.0 * exact, 0.04 / 5000.0);
    double t = -1.0;
    SheetPoint where;
    ASSERT_EQ(sheet.first_hit(x, v, radius, 0.0, end, t, where), exact < end);
    if (exact >= end) continue;
    EXPECT_NEAR(t, exact, 2e-9 * radius / -v.z);
  }
}

}  // namespace
}  // namespace standoff::particles
