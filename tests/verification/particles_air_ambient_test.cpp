// Laws of air at rest, all cells awake on purpose.
//
// Open box for 5 ms: still air beyond the box sends its half-Maxwellian and takes what flies out, so number, pressure
// and temperature inside fluctuate about the ambient ones. N particles in a grand canonical ensemble: the number has
// the standard deviation sqrt(N); averaged over k independent states (the box renews itself in about a side over the
// thermal speed) sqrt(N / k). The kinetic energy of n independent particles is known to sqrt(2 / (3 n)). Bounds: four
// standard deviations. Plate at rest in it: the front feels p A t from hits. A hit carries 2 m |v_n|; the variance of
// the sum of Poisson hits is their number times the mean square, 8 m^2 s^2 for a Rayleigh distributed v_n. Bird,
// Molecular Gas Dynamics (1994), 4.22.
#include <gtest/gtest.h>

#include "tests/unit/particles_air_scenes.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

Boundaries box_exits(const AirBox& box) {
  return Boundaries({box.lower, box.upper, false, 1});
}

TEST(AmbientAir, OpenBoxFor5Milliseconds_StaysAmbient) {
  const AirBox box{{-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}, 0.0125};
  const auto air = air_in(box);
  AirLoop loop(*air, nullptr, box_exits(box));
  loop.wake_everything();
  const double s = air->ambient.thermal_speed(), dt = 0.2 * box.cell / s, expected = 512 * box.particles_a_cell;
  double number = 0.0, kinetic = 0.0, internal = 0.0;
  long steps = 0;
  for (double t = 0.0; t < 5e-3; t += dt, ++steps) {
    loop.step(dt);
    number += static_cast<double>(air->particles.size());
    for (const Vec3& v : air->particles.velocity) kinetic += 0.5 * air->particles.mass * squared_norm(v);
    for (const double e : air->particles.internal_energy) internal += e;
  }
  const double renewals = 5e-3 * s / 0.1, kt = air->particles.mass * s * s, free_particles = renewals * expected;
  EXPECT_NEAR(number / steps, expected, 4.0 * std::sqrt(expected / renewals)) << "particles in the box";
  EXPECT_NEAR(kinetic / number, 1.5 * kt, 1.5 * kt * 4.0 * std::sqrt(2.0 / (3.0 * free_particles))) << "J a particle";
  EXPECT_NEAR(internal / number, kt, kt * 4.0 / std::sqrt(free_particles)) << "J a particle";
  EXPECT_GT(loop.collisions(), 100000);
}

TEST(AmbientAir, CollisionsInABox_GiveTheMeanFreePath) {
  const AirBox box{{-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05}, 0.0125};
  const auto air = air_in(box);
  AirLoop loop(*air, nullptr, box_exits(box));
  loop.wake_everything();
  const double s = air->ambient.thermal_speed(), dt = 0.2 * box.cell / s;
  double particle_time = 0.0;
  for (int k = 0; k < 200; ++k) {
    particle_time += static_cast<double>(air->particles.size()) * dt;
    loop.step(dt);
  }
  // Each collision ends two free paths; mean speed sqrt(8 / pi) s [Bird 1994, eqs. 1.11, 4.7]. Four standard deviations
  // of the count of collisions, and of the mean number of particles in the box, which the path goes with.
  const double renewals = 200 * dt * s / 0.1, mean = 512 * box.particles_a_cell;
  const double path = particle_time * std::sqrt(8.0 / M_PI) * s / (2.0 * static_cast<double>(loop.collisions()));
  EXPECT_NEAR(path / air->mean_free_path, 1.0,
              4.0 * std::sqrt(1.0 / static_cast<double>(loop.collisions()) + 1.0 / (mean * renewals)))
      << path << " m";
}

TEST(AmbientAir, PlateAtRest_FeelsAmbientPressureOnBothFaces) {
  const AirBox box{{-0.1, -0.1, -0.02}, {0.1, 0.1, 0.06}, 0.02, 8.0, 0.06};
  const auto air = air_in(box);
  air->particles.radius = 0.001 * box.cell;  // spheres meet the rim from a radius beside the plate: its area grows
  SurfaceSheet sheet(test::flat_mesh(6, 0.06, 1e6), SheetOptions{});  // 120 mm square of heavy nodes: stays at rest
  AirLoop loop(*air, &sheet, box_exits(box));
  loop.wake_everything();
  const double s = air->ambient.thermal_speed(), dt = 0.1 * box.cell / s, area = 0.12 * 0.12;
  double time = 0.0;
  for (int k = 0; k < 2000; ++k, time += dt) loop.step(dt);
  const double wanted = air->ambient.pressure * area * time, m = air->particles.mass;
  const double hits = one_way_flux(air->ambient) * area * time;
  // The heavy plate is not quite at rest: its area turns and stretches by parts in 1e9.
  EXPECT_NEAR(loop.rear / -wanted, 1.0, 1e-7) << "rear, N s";
  EXPECT_NEAR(loop.front, wanted, 4.0 * std::sqrt(8.0 * hits) * m * s) << "front, N s";
  EXPECT_LT(std::sqrt(8.0 * hits) * m * s, 0.02 * wanted) << "the statistics can tell";
}

TEST(AmbientAir, StillAir_IsNotSimulated) {
  const AirBox box{{-0.1, -0.1, -0.02}, {0.1, 0.1, 0.06}, 0.02, 8.0, 0.06};
  const auto air = air_in(box);
  SurfaceSheet sheet(test::flat_mesh(6, 0.06, 1e6), SheetOptions{});
  AirLoop loop(*air, &sheet, box_exits(box));
  for (int k = 0; k < 100; ++k) loop.step(1e-6);
  EXPECT_EQ(air->particles.size(), 0u);
  EXPECT_EQ(sheet.total_impulse().z, 0.0);
  EXPECT_EQ(air->cells.awake_count(), 0u);
}

}  // namespace
}  // namespace standoff::particles
