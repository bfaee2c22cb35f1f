// Waves and shocks in sand against closed forms.
//
// Chain: touching grains in a row, pressed so that no contact opens, are masses m on springs k. A standing wave of wave
// number q swings with w = 2 sqrt(k/m) sin(q a/2), a the distance of centres [Brillouin, Wave Propagation in Periodic
// Structures (1946), ch. III]; for long waves c = w/q = a sqrt(k/m). Velocity Verlet swings with (2/dt) asin(w dt/2)
// instead of w, exactly, if springs are linear. They are along the row, but for the rounding of positions, eps 0.06 m
// over an overlap of 4e-5 m = 4e-13 of a force in each of a hundred steps and more; 1e-9 leaves room.
//
// Column: loose sand of density rho with speed v that stagnates on a rigid wall stays there at its jammed density. The
// front rises with s: mass gives rho (v + s) = rho_jam s, momentum p = rho v (v + s), so p = rho v^2 / (1 -
// rho/rho_jam). Grains must lose their energy for it: damped contacts. Random packings jam between 0.56 (random loose,
// with friction) [Onoda, Liniger, Phys. Rev. Lett. 64 (1990) 2727] and 0.64 (random close): p lies between the figures
// of the two.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "particle_solver/packing/packed_cell.hpp"
#include "particle_solver/step/sand_integrate.hpp"
#include "particle_solver/step/surface_contact.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

constexpr double radius = 1e-3, mass = 1e-5, stiffness = 1e7;

TEST(SandChain, StandingWave_SwingsWithTheFrequencyOfTheLattice) {
  constexpr int count = 32;
  constexpr double spacing = 1.98 * radius, amplitude = 0.5;  // m/s: moves grains by 1e-4 of their overlap at most
  for (const int waves : {1, 4, 16}) {
    const double q = 2.0 * std::numbers::pi * waves / (count * spacing);
    const double w = 2.0 * std::sqrt(stiffness / mass) * std::sin(0.5 * q * spacing);
    std::vector<Vec3> places;
    for (int i = 0; i < count; ++i) places.push_back({spacing * i, 0.01, 0.01});
    SandState sand = make_grains(places, radius, mass);
    const auto shape = [&](int i) { return std::cos(q * spacing * i); };
    for (int i = 0; i < count; ++i) sand.velocity[static_cast<std::size_t>(i)].x = amplitude * shape(i);
    SandPairs pairs({{stiffness, 0.3, 0.0}, {}, Vec3{spacing * count, 0.02, 0.02}, 0.2, 1});
    pairs.forces(sand, 0.0);
    const auto in_the_mode = [&] {
      double sum = 0.0, norm2 = 0.0;
      for (int i = 0; i < count; ++i) {
        sum += sand.velocity[static_cast<std::size_t>(i)].x * shape(i), norm2 += shape(i) * shape(i);
      }
      return sum / norm2 / amplitude;
    };
    const double quarter = 0.5 * std::numbers::pi / w;
    const int steps = static_cast<int>(std::ceil(quarter / (0.05 * std::sqrt(mass / stiffness))));
    const double dt = quarter / steps, stepped = 2.0 / dt * std::asin(0.5 * w * dt);
    for (int k = 1; k <= 4; ++k) {
      for (int n = 0; n < steps; ++n) sand_step(sand, pairs, dt);
      EXPECT_NEAR(in_the_mode(), std::cos(stepped * k * quarter), 1e-9) << waves << " waves, quarter " << k;
    }
    EXPECT_NEAR(momentum(sand).x, 0.0, 1e-15 * mass * amplitude * count * 8.0 * steps);
  }
}

TEST(SandColumn, OnARigidWall_PressesAsTheJammedColumnGrows) {
  constexpr int cells = 4;
  constexpr double fill = 0.30, speed = 200.0;
  const PackedCell& cell = pack_cell({500, fill, 0.0, 5});
  const double edge = radius / cell.mean_radius;  // of the cell, m
  std::vector<Vec3> places;
  for (int z = 0; z < cells; ++z)
    for (const Vec3& p : cell.position) places.push_back(edge * (p + Vec3{0, 0, double(z)}) + Vec3{0, 0, radius});
  SandState sand = make_grains(places, radius, mass);
  for (Vec3& v : sand.velocity) v.z = -speed;
  // Periodic across; so far along z that the column never meets its image.
  SandPairs pairs({{stiffness, 0.3, 0.3}, {}, Vec3{edge, edge, 40.0 * edge}, 0.0, 1});
  SurfaceContact contact({});
  const SurfaceMesh mesh = test::flat_mesh(8, 4.0 * edge, 1e9);  // kg: a rigid wall
  SurfaceSheet sheet(mesh, {});
  pairs.forces(sand, 0.0);
  const double density = mass * 500.0 / (edge * edge * edge);
  const auto law = [&](double jam) { return density * speed * speed / (1.0 - fill / jam); };
  // The front runs up the column with s = v / (jam/fill - 1) and through it in height / (v + s); taken between a
  // quarter and three quarters of that time, away from the layers that the wall orders.
  const double through = cells * edge / (speed * (1.0 + 1.0 / (0.6 / fill - 1.0)));
  double impulse = 0.0, time = 0.0, from = 0.0;
  sheet.begin_window(test::at_rest(mesh), true);
  for (double t = 0.0; t < 0.75 * through;) {
    const double dt = pairs.stable_step();
    half_kick(sand, dt);
    const double given = contact.run(sand, sheet, dt).plate_impulse;
    if (t > 0.25 * through) impulse += given, from = from == 0.0 ? t : from, time = t + dt - from;
    drift(sand, dt);
    pairs.forces(sand, dt);
    half_kick(sand, dt);
    t += dt;
  }
  const double pressure = impulse / (time * edge * edge);
  EXPECT_GT(pressure, law(0.64)) << "Pa; " << density << " kg/m3";
  EXPECT_LT(pressure, law(0.56)) << "Pa; " << density << " kg/m3";
}

}  // namespace
}  // namespace standoff::particles
