// Law: with C_D held, drag makes 1/|v| grow linearly with time, and v t = ln(1 + beta v0 t)/beta: exact for the
// constant C_D = 0.44 above Re = 1000, whatever the step, so 1e-12. At Re = 1, C_D = 24 (1 + 0.15) = 27.6 [Schiller &
// Naumann 1935]. What is taken is booked: energy and momentum to rounding. Off: no stage, no books.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_solver/effects/particle_effect.hpp"
#include "particle_solver/kernels/air_drag.hpp"
#include "particle_solver/step/time_loop.hpp"
#include "tests/unit/case_folder.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

CaseSpec soil_without_charge_nearby(const char* drag) {
  standoff::test::CaseFolder folder;
  folder.write("case.toml", fmt::format(R"([charge]
explosive = "c4"
mass = "150 g"
radius = "28.2 mm"
particles = 400
[plate]
material = "al6xn"
size = ["406 mm", "406 mm", "3.4 mm"]
[run]
stand_off = "150 mm"
until = "0.3 ms"
[soil]
kind = "dry"
inner_radius = "30 mm"
outer_radius = "76.2 mm"
particles = 2000
[effects]
air_drag = "{}"
)",
                                        drag));
  const CaseRead read = folder.read();
  EXPECT_TRUE(read.errors.empty()) << standoff::test::all_errors(read);
  return read.spec;
}

SandState one_grain(double radius, double speed) {
  SandState sand;
  sand.radius = radius, sand.mass = 2700.0 * 4.0 / 3.0 * 3.141592653589793 * radius * radius * radius;
  sand.position = {{0, 0, 1}}, sand.velocity = {{0, 0, -speed}}, sand.force = {{}}, sand.id = {0};
  return sand;
}

TEST(AirDrag_FastGrain, FollowsTheClosedForm) {
  const CaseSpec spec = soil_without_charge_nearby("on");
  const auto effects = particle_effects(spec, 1);
  ASSERT_EQ(effects.size(), 1u);
  SandState sand = one_grain(1e-3, 600.0);
  const double energy = 0.5 * sand.mass * 600.0 * 600.0, momentum = -sand.mass * 600.0;
  for (int k = 0; k < 100; ++k) effects[0]->run(sand, 1e-5);
  const double rate = 0.5 * 0.44 * spec.air.density * 3.141592653589793 * 1e-6 / sand.mass;  // 1/m
  EXPECT_NEAR(-sand.velocity[0].z, 600.0 / (1.0 + rate * 600.0 * 1e-3), 600.0 * 1e-12);
  EXPECT_NEAR(effects[0]->books.loss + 0.5 * sand.mass * squared_norm(sand.velocity[0]), energy, 1e-12 * energy);
  EXPECT_NEAR(effects[0]->books.momentum.z + sand.mass * sand.velocity[0].z, momentum, -1e-12 * momentum);
}

TEST(AirDrag_Coefficient, IsThatOfSchillerAndNaumann) {
  EXPECT_DOUBLE_EQ(sphere_drag_coefficient(1.0), 27.6);
  EXPECT_DOUBLE_EQ(sphere_drag_coefficient(1e5), 0.44);
  EXPECT_EQ(drag_factor(0.0, 1e-3, 1e-6, 1.3, 1.8e-5, 1.0), 1.0);
}

TEST(AirDrag_InAScene, KeepsTheBooksAndIsAbsentWhenOff) {
  for (const char* drag : {"on", "off"}) {
    const CaseSpec spec = soil_without_charge_nearby(drag);
    const SurfaceMesh mesh = test::sheet_mesh(6, 0.0, 0.203, 1e-2, [](double x, double y) { return Vec3{x, y, 0.0}; });
    Scene scene = build_scene(spec, mesh, 1);
    TimeLoop loop(spec, scene, 1);
    ParticleLedger ledger;
    ledger.open(loop.energy(), loop.momentum_everywhere());
    for (int k = 0; k < 40; ++k) {
      loop.advance(2e-6 * k, 2e-6);
      ledger.observe(loop.energy());
    }
    EXPECT_LT(ledger.energy_error(), 0.01) << drag;  // of velocity Verlet
    EXPECT_LT(norm(loop.momentum_everywhere() - ledger.initial_momentum()), 1e-11 * (1.0 + loop.impulse_scale()))
        << drag;
    const bool on = std::string(drag) == "on";
    const auto& rows = loop.timers().rows();
    EXPECT_EQ(std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.name == "air_drag"; }), on);
    EXPECT_EQ(loop.effects().empty(), !on);
    EXPECT_EQ(loop.energy().effect_loss > 0.0, on);
  }
}

}  // namespace
}  // namespace standoff::particles
