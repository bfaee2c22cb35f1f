// A sheet that is a quarter of a pipe about z, seen from inside: closest point, swept hit and momentum. The sheet is a
// polygon of 24 flats a quarter: its faces lie between R cos(pi/96) and R, 5e-4 of R apart.
#include <gtest/gtest.h>

#include "particle_solver/state/surface_sheet.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

constexpr double radius = 0.0127, length = 0.3;
constexpr int around = 24, along = 60;

SurfaceMesh pipe_mesh() {
  // x from 0 to 1 runs from the y axis to the x axis, as in the structure's pipe: normals look at the axis.
  SurfaceMesh mesh;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i <= around; ++i) {
      const double angle = 0.5 * M_PI * i / around;
      mesh.position.push_back(
          {i == 0 ? 0.0 : radius * std::sin(angle), i == around ? 0.0 : radius * std::cos(angle), length * j / along});
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * (around + 1) + i;
      mesh.quads.push_back({a, a + 1, a + around + 2, a + around + 1});
    }
  mesh.node_mass.assign(mesh.position.size(), 1e-4);
  return mesh;
}

SurfaceSheet pipe() {
  SurfaceSheet sheet(pipe_mesh(), {.quarter = true});
  sheet.begin_window(test::at_rest(pipe_mesh()), false);
  return sheet;
}

TEST(SurfacePipe, PointsInside_SeeTheWallAtTheirDistanceFromTheCircle) {
  const SurfaceSheet sheet = pipe();
  EXPECT_FALSE(sheet.is_level());
  CounterRandom random{5, RandomUse::test, 1};
  for (int n = 0; n < 500; ++n) {
    const double angle = 0.5 * M_PI * random.uniform(), r = radius * test::between(random, 0.3, 0.999);
    const Vec3 x{r * std::cos(angle), r * std::sin(angle), length * test::between(random, 0.05, 0.95)};
    const SheetPoint seen = sheet.closest(x, radius);
    ASSERT_GE(seen.face, 0);
    EXPECT_NEAR(seen.gap, radius - r, 6e-4 * radius);
    EXPECT_GT(dot(seen.normal, Vec3{-std::cos(angle), -std::sin(angle), 0.0}), 0.99);
  }
}

TEST(SurfacePipe, SphereFlyingOutwards_HitsWhenItTouches) {
  const SurfaceSheet sheet = pipe();
  CounterRandom random{6, RandomUse::test, 1};
  const double size = 0.0005, speed = 3000.0;
  for (int n = 0; n < 200; ++n) {
    const double angle = 0.5 * M_PI * random.uniform();
    const Vec3 out{std::cos(angle), std::sin(angle), 0.0};
    double t = 0.0;
    SheetPoint where;
    ASSERT_TRUE(sheet.first_hit({0.0, 0.0, 0.15}, speed * out, size, 0.0, 1e-5, t, where));
    EXPECT_NEAR(t * speed, radius - size, 6e-4 * radius);
  }
}

TEST(SurfacePipe, Hit_GivesAndTakesTheSameMomentumAndEnergy) {
  SurfaceSheet sheet = pipe();
  Vec3 v{2000.0, 1500.0, 300.0};
  const Vec3 before = v;
  double t = 0.0;
  SheetPoint where;
  ASSERT_TRUE(sheet.first_hit({0.0, 0.0, 0.1}, v, 0.0005, 0.0, 1e-5, t, where));
  const double mass = 1e-6;
  const Impact impact = sheet.collide(where, mass, 1.0, 0.0, t, v);
  EXPECT_LT(norm(mass * (before - v) - impact.impulse), 1e-12 * mass * norm(before));
  EXPECT_NEAR(impact.work, 0.5 * mass * (squared_norm(before) - squared_norm(v)), 1e-12 * mass * squared_norm(before));
  EXPECT_LT(dot(v, Vec3{0.8, 0.6, 0.0}), 0.0) << "thrown back";
}

}  // namespace
}  // namespace standoff::particles
