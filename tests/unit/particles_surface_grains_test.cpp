// Laws of the stage surface_contact: a perfectly inelastic contact keeps a loaded grain from creeping into the plate;
// on a plane of any quads a grain slides and rolls as on the plane, without feeling seams; incoming momentum is booked
// once and rebound at the last contact. Tolerance: rounding, 1e-12 relative, unless a line says otherwise.
#include <gtest/gtest.h>

#include "particle_solver/step/surface_contact.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

constexpr double radius = 0.7e-3, mass = 5e-5;

SandState one_grain(const Vec3& x, const Vec3& v) {
  SandState sand;
  sand.radius = radius, sand.mass = mass;
  sand.position = {x}, sand.velocity = {v}, sand.force = {{}};
  sand.id = {0};
  return sand;
}

/// A heavy plane of irregular quads.
SurfaceMesh random_plane() {
  CounterRandom random(8, RandomUse::test, 1);
  const double h = 0.002;
  return sheet_mesh(20, -0.02, 0.02, 1e9, [&](double x, double y) {
    return Vec3{x + between(random, -0.3 * h, 0.3 * h), y + between(random, -0.3 * h, 0.3 * h), 0.0};
  });
}

TEST(GrainPressedOnThePlate_WithRestitutionZero, DoesNotCreepIn) {
  SurfaceSheet sheet(random_plane(), {});
  SandState sand = one_grain({0.0, 0.0, 0.999 * radius}, {});
  SurfaceContact contact(SurfaceContactOptions{});
  const double h = 1e-8, force = -1000.0;  // N: as deep in a shocked layer
  for (int step = 0; step < 1000; ++step) {
    sand.velocity[0].z += force / mass * h;
    const SurfaceContactCounts counts = contact.run(sand, sheet, h);
    EXPECT_NEAR(counts.plate_impulse, -force * h, 1e-12 * -force * h) << "N s";
    sand.position[0] += sand.velocity[0] * h;
  }
  EXPECT_NEAR(sand.position[0].z, 0.999 * radius, 1e-14) << "m";
}

TEST(GrainSlidingOverSeams_WithAnyLaw, FeelsNone) {
  for (const bool spring : {false, true}) {
    SurfaceSheet sheet(random_plane(), {});
    SurfaceContactOptions options;
    options.spring = spring;
    options.soil = {1e6, 0.0, 0.0};  // undamped: a bump at a seam would ring on
    SurfaceContact contact(options);
    const double depth = spring ? 100.0 / 1e6 : 0.0, h = 2e-7;  // m: the spring carries 100 N there
    SandState sand = one_grain({-0.015, 0.0003, radius - depth}, {100.0, 20.0, 0.0});
    for (int step = 0; step < 1400; ++step) {  // 28 mm, 14 seams along x and 3 along y
      sand.velocity[0].z += -100.0 / mass * h;
      contact.run(sand, sheet, h);
      sand.position[0] += sand.velocity[0] * h;
    }
    EXPECT_NEAR(sand.velocity[0].x, 100.0, 1e-9) << "m/s: 1400 directions, each true to 1e-12";
    EXPECT_NEAR(sand.velocity[0].y, 20.0, 1e-9);
    EXPECT_NEAR(sand.velocity[0].z, 0.0, 1e-9);
    EXPECT_NEAR(sand.position[0].z, radius - depth, 1e-12);
  }
}

TEST(GrainOnThePlate_HittingTwice, BooksIncomingOnceAndTheLastRebound) {
  SurfaceSheet sheet(random_plane(), {});
  SandState sand = one_grain({0.0, 0.0, 0.9 * radius}, {0.0, 0.0, -100.0});
  SurfaceContactOptions options;
  options.impact.restitution = 0.5;
  SurfaceContact contact(options);
  SurfaceContactCounts counts = contact.run(sand, sheet, 1e-8);
  EXPECT_EQ(counts.hits, 1);
  EXPECT_NEAR(counts.plate_incoming, 100.0 * mass, 1e-15);
  EXPECT_NEAR(counts.plate_impulse, 150.0 * mass, 1e-10 * mass);  // the plate's mass is 1e9 kg, not infinite
  EXPECT_NEAR(counts.loss, 0.5 * mass * (1e4 - 2500.0), 1e-12);
  EXPECT_NEAR(counts.penetration_over_radius, 0.1, 1e-12);
  EXPECT_NEAR(sand.plate_rebound[0], 50.0 * mass, 1e-10 * mass);
  counts = contact.run(sand, sheet, 1e-8);  // leaving
  EXPECT_EQ(counts.hits, 0);
  sand.velocity[0].z = -20.0;
  counts = contact.run(sand, sheet, 1e-8);
  EXPECT_EQ(counts.plate_incoming, 0.0);
  EXPECT_NEAR(sand.plate_rebound[0], 10.0 * mass, 1e-10 * mass);
}

TEST(GrainOnTheSoilSpring_Undamped, ReboundsWithItsOwnSpeed) {
  SurfaceSheet sheet(random_plane(), {});
  SandState sand = one_grain({0.0, 0.0, radius}, {0.0, 0.0, -10.0});
  SurfaceContactOptions options;
  options.spring = true;
  options.soil = {1e6, 0.0, 0.0};
  SurfaceContact contact(options);
  const double h = 0.01 * std::sqrt(mass / 1e6);
  double impulse = 0.0;
  for (int step = 0; step < 1000; ++step) {
    impulse += contact.run(sand, sheet, h).plate_impulse;
    sand.position[0] += sand.velocity[0] * h;
  }
  EXPECT_NEAR(sand.velocity[0].z, 10.0, 0.01 * 10.0);  // leapfrog entered up to one step late: h sqrt(k/m) = 0.01
  EXPECT_NEAR(impulse, mass * (sand.velocity[0].z + 10.0), 1e-14);
}

// Law: a spring pressed by d holds k d^2 / 2; that of a grain that is taken out is what leaves with it, no more. Exact.
TEST(GrainsOnTheSoilSpring_OneTakenOut, ItsSpringIsToldApart) {
  SurfaceSheet sheet(random_plane(), {});
  SandState sand = one_grain({0.0, 0.0, 0.9 * radius}, {});
  sand.position.push_back({0.005, 0.0, 0.8 * radius}), sand.position.push_back({0.01, 0.0, 2.0 * radius});
  sand.velocity.resize(3), sand.force.resize(3), sand.id = {0, 1, 2};
  SurfaceContactOptions options;
  options.spring = true;
  options.soil = {1e6, 0.0, 0.0};
  SurfaceContact contact(options);
  const double all = contact.run(sand, sheet, 1e-8).elastic_energy;
  const auto spring = [](double share) { return 0.5 * 1e6 * share * share * radius * radius; };
  EXPECT_NEAR(contact.stored_in({0}), spring(0.1), 1e-12 * all);
  EXPECT_NEAR(contact.stored_in({1, 2}), spring(0.2), 1e-12 * all);
  EXPECT_EQ(contact.stored_in({2}), 0.0) << "it hangs above the plate";
  EXPECT_NEAR(contact.stored_in({0, 1, 2}), all, 1e-14 * all);
}

TEST(GrainsOnThePlate_WithOneOrThreeThreads, EndWithTheSameBits) {
  CounterRandom random(8, RandomUse::test, 2);
  SandState start = one_grain({}, {});
  start.position.clear(), start.velocity.clear(), start.id.clear();
  for (std::uint32_t i = 0; i < 500; ++i) {
    start.position.push_back(
        {between(random, -0.01, 0.01), between(random, -0.01, 0.01), between(random, 0.2, 0.9) * radius});
    start.velocity.push_back(Vec3{0, 0, -400} + random_vector(random, 300.0)), start.id.push_back(i);
  }
  SurfaceMesh light = random_plane();
  light.node_mass.assign(light.node_mass.size(), 1e-4);
  std::vector<std::vector<Vec3>> velocity;
  for (const int threads : {1, 3}) {
    SandState sand = start;
    SurfaceSheet sheet(light, {});
    SurfaceContactOptions options;
    options.impact = {0.3, 0.2}, options.threads = threads;
    EXPECT_GT(SurfaceContact(options).run(sand, sheet, 1e-8).hits, 50);
    velocity.push_back(sand.velocity);
    velocity.push_back({sheet.node_velocity().begin(), sheet.node_velocity().end()});
  }
  EXPECT_EQ(velocity[0], velocity[2]);
  EXPECT_EQ(velocity[1], velocity[3]);
}

}  // namespace
}  // namespace standoff::particles
