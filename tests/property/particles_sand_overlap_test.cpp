// Overlaps that a scene starts with, or that a grain takes along when it leaves. A body of sand lies at rest before the
// charge goes off, so nothing in it may be pressed: packing moves grains apart until the largest overlap is 1e-4 d.
// What is left are springs like any other: their energy is part of the first reading of the ledger and no more than it
// comes back. Tolerance of energies: a contact that ends within a step shifts at most (w dt)^2/4 = 0.5 % of its energy,
// see grain_contact.hpp; where nothing moves it is the rounding of a sum of few numbers, 1e-14 of it.
#include <gtest/gtest.h>

#include "particle_solver/packing/sand_body.hpp"
#include "particle_solver/step/sand_integrate.hpp"
#include "particle_solver/step/time_loop.hpp"
#include "tests/unit/case_folder.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

constexpr double radius = 1e-3, mass = 1e-5, stiffness = 1e7;

double energy(const SandState& sand, const SandPairs& pairs) {
  const SandBooks& b = pairs.books();
  return kinetic_energy(sand) + b.elastic_energy + b.friction_loss + b.damping_loss + b.escaped_elastic;
}

class PackedShell : public testing::TestWithParam<SoilKind> {};

TEST_P(PackedShell, LeftAlone_GainsNoMoreThanTheSpringsHeldAtTheStart) {
  SoilSpec soil;
  const bool wet = GetParam() == SoilKind::wet;
  soil.kind = GetParam(), soil.inner_radius = 0.03, soil.outer_radius = 0.0762, soil.particles = 4000;
  soil.packing = wet ? 0.64 : 0.60, soil.bulk_density = wet ? 2020.0 : 1620.0, soil.stiffness = wet ? 4e9 : 0.4e9;
  soil.friction = wet ? 0.0 : 0.3, soil.damping = wet ? 0.01 : 0.0, soil.radius_spread = wet ? 0.025 : 0.0;
  SandBody body = fill_body(soil, {{0, 0, 0.15}, true, 1});
  SandState& sand = body.grains;
  SandPairs pairs({body.law, {true}, {}, 0.0, 1});
  pairs.forces(sand, 0.0);
  const double start = pairs.books().elastic_energy, pressed = 2.0 * sand.radius * 1e-4;
  // At most 12 neighbours each, all pressed by what packing may leave.
  EXPECT_LE(start, static_cast<double>(sand.size()) * 6.0 * 0.5 * body.law.stiffness * pressed * pressed);
  for (int n = 0; n < 200; ++n) {
    sand_step(sand, pairs, pairs.stable_step());
    EXPECT_LE(kinetic_energy(sand), 1.005 * start) << "step " << n;
  }
  EXPECT_NEAR(energy(sand, pairs) / start, 1.0, 0.005);
  EXPECT_LE(pairs.books().max_overlap_over_radius, 2.001e-4) << "nothing presses harder than at the start";
}

INSTANTIATE_TEST_SUITE_P(Kinds, PackedShell, testing::Values(SoilKind::dry, SoilKind::wet));

/// A row of pressed grains, the first one against its own image.
SandState pressed_row() {
  SandState sand =
      make_grains({{0.9e-3, 5e-3, 0}, {2.7e-3, 5e-3, 0}, {4.6e-3, 5e-3, 0}, {6.5e-3, 5e-3, 0}}, radius, mass);
  for (std::size_t i = 0; i < 4; ++i) sand.velocity[i] = {0.0, 5.0 * static_cast<double>(i), 2.0};
  return sand;
}

TEST(SandOverlap, GrainTakenOutWhilePressed_ItsSpringsAreBooked) {
  for (const std::size_t leaves : {0u, 1u, 3u}) {
    SandState sand = pressed_row();
    SandPairs pairs({{stiffness, 0.3, 0.05}, {true}, {}, 0.0, 1});
    pairs.forces(sand, 0.0);
    for (int n = 0; n < 5; ++n) sand_step(sand, pairs, pairs.stable_step());
    const double before = energy(sand, pairs), carried = 0.5 * mass * squared_norm(sand.velocity[leaves]);
    const double pressed = pairs.books().elastic_energy;
    const auto cut = [&](auto& array) { array.erase(array.begin() + static_cast<std::ptrdiff_t>(leaves)); };
    cut(sand.position), cut(sand.velocity), cut(sand.force), cut(sand.id);
    pairs.forces(sand, 0.0);
    EXPECT_LT(pairs.books().elastic_energy, 0.9 * pressed) << "it must really have been pressed";
    EXPECT_NEAR((energy(sand, pairs) + carried) / before, 1.0, 1e-14) << "grain " << leaves;
  }
}

TEST(SandOverlap, BodyPressedIntoThePlateAtTheStart_BringsThatEnergyItself) {
  // The shell touches the plate with its outer radius, so that half grains stand in it; restitution by the soil's law.
  standoff::test::CaseFolder folder;
  folder.write("case.toml", R"([soil]
kind = "dry"
inner_radius = "30 mm"
outer_radius = "76.2 mm"
particles = 4000
[contact]
surface_restitution = "soil"
[plate]
material = "al6xn"
size = ["406 mm", "406 mm", "3.4 mm"]
[run]
stand_off = "76.2 mm"
)");
  const CaseRead read = folder.read();
  ASSERT_TRUE(read.errors.empty()) << standoff::test::all_errors(read);
  const auto flat = [](double x, double y) { return Vec3{x, y, 0.0}; };
  const SurfaceMesh mesh = test::sheet_mesh(8, 0.0, 0.203, 1e3, flat);
  Scene scene = build_scene(read.spec, mesh, 1);
  TimeLoop loop(read.spec, scene, 1);
  const double start = loop.energy().total(), window = 1e-6;
  EXPECT_GT(loop.totals().contact_elastic, 0.0);
  for (int k = 0; k < 20; ++k) {
    scene.sheet.begin_window(test::at_rest(mesh), true);
    loop.advance(window * k, window);
    // The push on the sheet is taken at the start of a step: w dt = 0.1 of a contact's energy is out at most at a time.
    EXPECT_NEAR(loop.energy().total() / start, 1.0, 0.1) << "window " << k;
  }
  EXPECT_GT(loop.energy().sand_kinetic, 0.1 * start) << "it must really push";
}

}  // namespace
}  // namespace standoff::particles
