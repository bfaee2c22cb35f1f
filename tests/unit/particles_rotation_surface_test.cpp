// A rough sphere on the sheet. Laws: what acts at the point of contact leaves the angular momentum about it alone, so a
// sphere thrown sliding ends rolling with m a v0 = m a v + I w, v = a w:  v = v0 m a^2/(m a^2 + I), 5/7 of v0 for a = r
// [Coulomb 1821; e.g. Goldsmith, Impact (1960), ch. 2], whatever mu; an impulse keeps energy but for its loss.
// Tolerance: rounding, 1e-13 of a value in one hit; 1e-9 after 3000 hits, each true to 1e-12.
#include <gtest/gtest.h>

#include "particle_solver/step/surface_contact.hpp"
#include "tests/unit/particles_surface_builders.hpp"
#include "tests/unit/particles_turning_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

constexpr double radius = 0.7e-3, mass = 5e-5;

/// Irregular quads, all in one plane.
SurfaceMesh random_plane(double node_mass) {
  CounterRandom random(8, RandomUse::test, 1);
  const double h = 0.002;
  return sheet_mesh(20, -0.02, 0.02, node_mass, [&](double x, double y) {
    return Vec3{x + between(random, -0.3 * h, 0.3 * h), y + between(random, -0.3 * h, 0.3 * h), 0.0};
  });
}

SurfaceContactOptions rough(bool spring, double mu) {
  SurfaceContactOptions options;
  options.spring = spring, options.impact.friction = mu, options.soil = {1e6, 0.0, mu}, options.turning = true;
  return options;
}

TEST(SphereThrownSliding_OnARoughPlane, EndsRollingAtFiveSevenths) {
  for (const bool spring : {false, true})
    for (const double mu : {0.1, 0.5}) {
      SurfaceSheet sheet(random_plane(1e9), {});
      const double press = 100.0, h = 2e-7, a = radius - (spring ? press / 1e6 : 0.0);  // N, s, m
      SandState sand = make_grains({{-0.015, 0.0003, a}}, radius, mass);
      let_grains_turn(sand);
      sand.velocity[0] = {40.0, 8.0, 0.0};
      SurfaceContact contact(rough(spring, mu));
      const double before = kinetic_energy(sand), start = norm(sand.velocity[0]);
      double loss = 0.0, pressed = 0.0;
      for (int step = 0; step < 3000; ++step) {
        sand.velocity[0].z -= press / mass * h;
        if (!spring) pressed += 0.5 * mass * sand.velocity[0].z * sand.velocity[0].z;  // taken out again by the impact
        loss += contact.run(sand, sheet, h).loss;
        sand.position[0] += sand.velocity[0] * h;
      }
      const double inertia = moment_of_inertia(mass, radius), end = start * mass * a * a / (mass * a * a + inertia);
      if (!spring) {
        EXPECT_NEAR(end, 5.0 / 7.0 * start, 1e-14 * start);
      }
      EXPECT_NEAR(norm(sand.velocity[0]), end, 1e-9 * start) << "m/s, mu " << mu << (spring ? ", spring" : ", impacts");
      EXPECT_LT(norm(sand.velocity[0] - cross(sand.spin[0], Vec3{0, 0, a})), 1e-9 * start) << "it rolls without slip";
      EXPECT_NEAR(kinetic_energy(sand) + rotation_energy(sand) + loss, before + pressed, 1e-9 * before) << "J";
      EXPECT_NEAR(norm(sheet.total_impulse() + Vec3{0, 0, press * h * 3000}), mass * (start - end),
                  1e-9 * mass * start);
    }
}

TEST(RoughImpact_OfAnySphereOnALightPlane, KeepsEnergyAndAngularMomentum) {
  CounterRandom random(8, RandomUse::test, 3);
  for (int i = 0; i < 300; ++i) {
    SurfaceSheet sheet(random_plane(between(random, 1e-5, 1e-3)), {});
    const Vec3 x{between(random, -0.01, 0.01), between(random, -0.01, 0.01), between(random, 0.5, 1.0) * radius};
    Vec3 v = random_vector(random, 300.0) + Vec3{0, 0, -300.0}, w = random_vector(random, 3e5);
    const SheetPoint where = sheet.closest(x, radius);
    const double inertia = moment_of_inertia(mass, radius), mu = between(random, 0.0, 1.0);
    const Vec3 arm = x - where.point, turning = cross(arm, v) * mass + w * inertia;
    const auto energy = [&] { return 0.5 * mass * squared_norm(v) + 0.5 * inertia * squared_norm(w); };
    const double before = energy();
    const Impact hit = sheet.collide(where, TurningSphere(mass, radius, where.gap, v, w), 0.3, mu, 0.0);
    EXPECT_LT(norm(cross(arm, v) * mass + w * inertia - turning), 1e-13 * norm(turning)) << "kg m2/s";
    EXPECT_NEAR(energy() + hit.work + hit.loss, before, 1e-13 * before) << "J";
    EXPECT_GE(hit.loss, 0.0);
  }
}

}  // namespace
}  // namespace standoff::particles
