// Laws: forces at the point of contact keep the angular momentum of paths and spins together, in every step, to
// rounding: 400 steps of 2000 grains are 8e5 roundings, a random walk of 9e2 eps = 2e-13 of the sum of all |x x m v| +
// |I w|. Energy closes as without turning, half a percent (particles_sand_books_test.cpp): contacts that begin and end
// within a step shift it by k (v dt)^2/8. Any number of threads: the same bits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling/base/state_archive.hpp"
#include "coupling/base/state_hash.hpp"
#include "particle_solver/packing/packed_cell.hpp"
#include "particle_solver/step/time_loop.hpp"
#include "tests/unit/case_folder.hpp"
#include "tests/unit/particles_sand_clouds.hpp"
#include "tests/unit/particles_surface_builders.hpp"
#include "tests/unit/particles_turning_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

SandState turning_clouds(bool radii) {
  SandState sand = two_clouds(radii);
  let_grains_turn(sand);
  return sand;
}

struct Crash {
  Crash(const GrainLaw& law, bool radii, int threads, int steps)
      : sand(turning_clouds(radii)), pairs(turning_pairs(law, false, threads)), energy(kinetic_energy(sand)) {
    const Vec3 start = angular_momentum(sand);
    pairs.forces(sand, 0.0);
    for (int n = 0; n < steps; ++n) turning_step(sand, pairs, pairs.stable_step(), threads);
    change = norm(angular_momentum(sand) - start);
    for (std::size_t i = 0; i < sand.size(); ++i) {
      hash.add(sand.position[i]), hash.add(sand.velocity[i]), hash.add(sand.spin[i]);
      scale += norm(cross(sand.position[i], sand.velocity[i])) * sand.mass_of(i);
    }
  }
  SandState sand;
  SandPairs pairs;
  double energy, change = 0.0, scale = 0.0;
  StateHash hash;
};

TEST(TurningClouds_CollidingAt600MetresPerSecond, KeepAngularMomentumAndEnergy) {
  for (const bool radii : {false, true}) {
    const Crash crash({1e7, 0.3, radii ? 0.05 : 0.0}, radii, 1, 400);
    EXPECT_LT(crash.change, 1e-12 * crash.scale) << "kg m2/s";
    EXPECT_NEAR(all_energy(crash.sand, crash.pairs) / crash.energy, 1.0, 0.005);
    EXPECT_GT(rotation_energy(crash.sand), 0.01 * crash.energy) << "J: without it the books must not close";
  }
}

TEST(TurningClouds_WithOneOrThreeThreads, GiveTheSameBits) {
  const auto bits = [](int threads) { return Crash({1e7, 0.3, 0.02}, true, threads, 60).hash.value(); };
  EXPECT_EQ(bits(3), bits(1));
}

CaseRead buried_charge(const char* rotation, double mu) {
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
stand_off = "76.2 mm"
until = "0.3 ms"
[contact]
surface_friction = 0.3
[soil]
kind = "dry"
friction = {}
inner_radius = "30 mm"
outer_radius = "76.2 mm"
particles = 2000
[effects]
{}
)",
                                        mu, rotation));
  return folder.read();
}

TEST(GrainRotation_InAScene, KeepsTheBooksAndIsAbsentUnlessStated) {
  for (const char* stated : {"grain_rotation = \"on\"", ""}) {
    const CaseSpec spec = buried_charge(stated, 0.3).spec;
    const bool on = *stated != 0;
    const SurfaceMesh mesh = sheet_mesh(6, 0.0, 0.203, 1e-2, [](double x, double y) { return Vec3{x, y, 0.0}; });
    Scene scene = build_scene(spec, mesh, 1);
    TimeLoop loop(spec, scene, 1);
    ParticleLedger ledger;
    ledger.open(loop.energy(), loop.momentum_everywhere());
    for (int k = 0; k < 40; ++k) loop.advance(2e-6 * k, 2e-6), ledger.observe(loop.energy());
    EXPECT_LT(ledger.energy_error(), 0.005);
    EXPECT_LT(norm(loop.momentum_everywhere() - ledger.initial_momentum()), 1e-11 * (1.0 + loop.impulse_scale()));
    const auto& rows = loop.timers().rows();
    EXPECT_EQ(std::any_of(rows.begin(), rows.end(), [](const auto& row) { return row.name == "grain_rotation"; }), on);
    EXPECT_EQ(scene.sand.spin.capacity() + scene.sand.torque.capacity() > 0, on);
    EXPECT_EQ(loop.energy().sand_rotation > 0.0, on);
  }
}

TEST(GrainRotation_SavedAndReadAmidTheLoad, GoesOnWithTheSameBits) {
  const CaseSpec spec = buried_charge("grain_rotation = \"on\"", 0.3).spec;
  const SurfaceMesh mesh = sheet_mesh(6, 0.0, 0.203, 1e-2, [](double x, double y) { return Vec3{x, y, 0.0}; });
  Scene one = build_scene(spec, mesh, 1), two = build_scene(spec, mesh, 2);
  TimeLoop whole(spec, one, 1), resumed(spec, two, 2);
  const auto saved = [](TimeLoop& loop) {
    StateWriter writer;
    loop.forget_times(), writer(loop);
    return writer.bytes();
  };
  for (int k = 0; k < 18; ++k) whole.advance(2e-6 * k, 2e-6);
  const std::string middle = saved(whole);
  StateReader reader(middle);
  reader(resumed);
  for (int k = 18; k < 26; ++k) whole.advance(2e-6 * k, 2e-6), resumed.advance(2e-6 * k, 2e-6);
  EXPECT_TRUE(saved(resumed) == saved(whole));
  EXPECT_NE(one.sheet.total_impulse().z, 0.0) << "the plate must have been hit";
}

TEST(GrainRotation_WithoutFriction, CannotBeStatedOrGoesWithIt) {
  const CaseRead smooth = buried_charge("grain_rotation = \"on\"", 0.0);
  EXPECT_NE(standoff::test::all_errors(smooth).find("no tangential force turns them"), std::string::npos);
  const CaseRead off = buried_charge("grain_rotation = \"on\"\nfriction = \"off\"", 0.3);
  EXPECT_TRUE(off.errors.empty());
  EXPECT_FALSE(off.spec.effect("grain_rotation"));
}

}  // namespace
}  // namespace standoff::particles
