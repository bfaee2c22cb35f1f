// Two rough spheres that stick while they touch. With the springs of grain_contact.hpp (the same k along normal and
// tangent) the surfaces slip as u = u0 cos(w_t t), w_t^2 = k/m_t, 1/m_t = 7/2 (1/m_1 + 1/m_2) for solid spheres of any
// radii, and the contact lasts pi/w_n, w_n^2 = k/m_red = 2/7 w_t^2:
//   u' = u0 cos(pi sqrt(7/2)),  tangential impulse J = m_t (u0 - u')     [Di Maio & Di Renzo, Chem. Eng. Sci. 59 (2004)
//   3461]
// Tolerance: a contact begins and ends within a step, a phase of w_t dt each: 2 w_t dt of u0. Shorter levers at overlap
// d, and the pair turning by u t / 2r, are below 1e-3 of it at these speeds. mu = 1000 slides only for the last 1e-5 of
// the time.
#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/particles_turning_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

constexpr double radius = 1e-3, mass = 1e-5, stiffness = 1e7;

/// Slip of i = 0 against j = 1 along y, the line of centres along x.
double surface_slip_y(const SandState& s) {
  const Vec3 n{-1.0, 0.0, 0.0};  // from 1 to 0
  return (s.velocity[0] - s.velocity[1] - cross(s.spin[0] * s.radius_of(0) + s.spin[1] * s.radius_of(1), n)).y;
}

TEST(RoughSpheres_StickingInAnImpact, SlipWithTwoSeventhsOfTheirMass) {
  for (const bool unequal : {false, true})
    for (const double spin : {0.0, 3.0}) {
      SandState grains = make_grains({{0, 0, 0}, {3.1e-3, 0, 0}}, radius, mass);
      grains.grain_radius = {radius, unequal ? 2.0 * radius : radius};
      grains.grain_mass = {mass, unequal ? 8.0 * mass : mass};
      grains.position[1].x = 1.0001 * (grains.grain_radius[0] + grains.grain_radius[1]);
      let_grains_turn(grains);
      grains.velocity = {{0.05, 0.01, 0}, {-0.05, 0, 0}}, grains.spin[1].z = spin;
      SandPairs pairs = turning_pairs({stiffness, 1000.0, 0.0});
      pairs.forces(grains, 0.0);
      const double m_t = 2.0 / 7.0 / (1.0 / mass + 1.0 / grains.grain_mass[1]), slip = surface_slip_y(grains);
      const double dt = 0.002 * std::sqrt(m_t / stiffness), before = grains.velocity[0].y;
      EXPECT_GT(std::abs(slip), 2e-3) << "m/s";
      while (grains.velocity[0].x > -1e-9 || pairs.books().elastic_energy > 0.0) turning_step(grains, pairs, dt);
      const double kept = std::cos(std::numbers::pi * std::sqrt(3.5)), impulse = m_t * slip * (1.0 - kept);
      EXPECT_NEAR(surface_slip_y(grains) / slip, kept, 2.0 * 0.002 + 1e-3) << "spin " << spin;
      EXPECT_NEAR((before - grains.velocity[0].y) * mass / impulse, 1.0, 0.005 / (1.0 - kept));
      // -J along y acts at the end of the radius, along x: I w = -r J about z.
      EXPECT_NEAR(-grains.spin[0].z * moment_of_inertia(mass, radius) / (radius * impulse), 1.0, 0.005 / (1.0 - kept));
    }
}

TEST(RoughSphere_OnItsOwnImage, GoesOnTurningAsInTheFullModel) {
  // Law: spin is an axial vector, so a quarter model and the full one do the same: A hits B, turns, and then meets its
  // image in x = 0. Tolerance: the image is met by another formula, which rounds differently in each of 2000 steps: eps
  // of a place (1e-3 m) over an overlap of 1e-5 m is 2e-14 of a force; 1e-9 of a value is ample.
  const std::vector<Vec3> places{{1.5 * radius, 5e-3, 0}, {3.6 * radius, 5.9e-3, 1e-4}};
  const std::vector<Vec3> velocities{{}, {-60.0, 5.0, -3.0}};
  std::vector<Vec3> all_places, all_velocities;
  for (int image = 0; image < 4; ++image)
    for (std::size_t i = 0; i < 2; ++i) {
      const double x = image & 1 ? -1.0 : 1.0, y = image & 2 ? -1.0 : 1.0;
      all_places.push_back({x * places[i].x, y * places[i].y, places[i].z});
      all_velocities.push_back({x * velocities[i].x, y * velocities[i].y, velocities[i].z});
    }
  const GrainLaw law{stiffness, 0.4, 0.05};
  SandState quarter = make_grains(places, radius, mass), full = make_grains(all_places, radius, mass);
  quarter.velocity = velocities, full.velocity = all_velocities;
  let_grains_turn(quarter), let_grains_turn(full);
  SandPairs mirrored = turning_pairs(law, true), pairs = turning_pairs(law);
  mirrored.forces(quarter, 0.0), pairs.forces(full, 0.0);
  double touched_turning = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const double dt = 0.2 * recommended_step(law, mass);
    turning_step(quarter, mirrored, dt), turning_step(full, pairs, dt);
    if (quarter.position[0].x < radius) touched_turning = std::max(touched_turning, norm(quarter.spin[0]) * radius);
  }
  EXPECT_GT(touched_turning, 1.0) << "m/s: it must turn while it touches its image";
  for (std::size_t k = 0; k < 8; ++k) {
    const double x = k / 2 & 1 ? -1.0 : 1.0, y = k / 4 & 1 ? -1.0 : 1.0;
    const Vec3 w = quarter.spin[k % 2], axial{y * w.x, x * w.y, x * y * w.z};
    EXPECT_LT(norm(full.spin[k] - axial), 1e-9 * norm(w)) << "rad/s, grain " << k;
    const Vec3 v = quarter.velocity[k % 2];
    EXPECT_LT(norm(full.velocity[k] - Vec3{x * v.x, y * v.y, v.z}), 1e-9 * norm(v)) << "m/s, grain " << k;
  }
}

}  // namespace
}  // namespace standoff::particles
