// Law: a sphere in free flight follows a straight line, so whether it meets the surface is geometry: the closed form
// must agree with positions along the line, sampled until it has left. Sand that flies apart with v = H (x - c) never
// overtakes itself: then taking out what flies past changes nothing on the plate, up to rounding of sums (1e-12), and
// what is taken out is booked: energy and momentum of everything stay to rounding.
#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "particle_solver/kernels/free_flight.hpp"
#include "particle_solver/scene/sand_front.hpp"
#include "particle_solver/step/time_loop.hpp"
#include "tests/unit/case_folder.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

constexpr SurfaceReach plate{0.0, 0.2, 0.2};

bool touches_on_the_way(const Vec3& x, const Vec3& v, double r) {
  for (int k = 0; k <= 4000; ++k) {
    const Vec3 at = x + v * (k * 1e-3);
    if (at.z <= plate.top + r && std::abs(at.x) <= plate.half_x + r && std::abs(at.y) <= plate.half_y + r) return true;
  }
  return false;
}

// One-sided: what is called past never touches. Of the others some may also pass (round a corner): those are kept.
TEST(FreeFlight, OfAnyDirectionCalledPast_NeverTouchesThePlate) {
  int past = 0, kept = 0;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    CounterRandom random(3, RandomUse::test, i);
    const auto uniform = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    const Vec3 x{uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(0.02, 0.3)};
    const Vec3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    const bool called_past = passes_the_surface(x, v, 0.01, plate);
    EXPECT_FALSE(called_past && touches_on_the_way(x, v, 0.01)) << "flight " << i;
    called_past ? ++past : ++kept;
  }
  EXPECT_GT(past, 200);
  EXPECT_GT(kept, 200);
}

TEST(FreeFlight, TowardsThePlate_IsKept) {
  EXPECT_FALSE(passes_the_surface({0, 0, 0.1}, {0, 0, -1}, 0.01, plate));
  EXPECT_TRUE(passes_the_surface({0, 0, 0.1}, {0, 0, 1}, 0.01, plate));
  EXPECT_FALSE(passes_the_surface({0, 0, 0.005}, {0, 0, 1}, 0.01, plate)) << "it touches";
  EXPECT_FALSE(passes_the_surface({0.3, 0, 0.1}, {-1, 0, -0.5}, 0.01, plate)) << "comes in from the side";
}

CaseSpec sand_ball(const char* drop) {
  CaseOverrides overrides;
  overrides.level = "coarse";
  overrides.set = {
      {"soil.particles", "2000"}, {"charge.particles", "400"}, {"soil.friction", "0"}, {"effects.drop_outgoing", drop}};
  const CaseRead read = read_case(std::string(STANDOFF_SOURCE_DIR) + "/cases/borvik_2011/dry_150mm", overrides);
  EXPECT_TRUE(read.errors.empty()) << standoff::test::all_errors(read);
  return read.spec;
}

struct Outcome {
  double impulse, energy_error, momentum_error, front;
  long left;
  bool has_row;
};

/// Sand without gas, each grain with v = H (x - c), flies for 0.6 ms: those towards the plate have hit it.
Outcome fly_apart(const char* drop) {
  const CaseSpec spec = sand_ball(drop);
  const SurfaceMesh mesh = test::sheet_mesh(6, 0.0, 0.203, 1e-2, [](double x, double y) { return Vec3{x, y, 0.0}; });
  Scene scene = build_scene(spec, mesh, 1);
  scene.has_gas = false, scene.gas = {};
  for (std::size_t i = 0; i < scene.sand.size(); ++i)
    scene.sand.velocity[i] = 8000.0 * (scene.sand.position[i] - scene.centre);
  TimeLoop loop(spec, scene, 1);
  ParticleLedger ledger;
  ledger.open(loop.energy(), loop.momentum_everywhere());
  for (int k = 0; k < 300; ++k) loop.advance(2e-6 * k, 2e-6), ledger.observe(loop.energy());
  const auto& rows = loop.timers().rows();
  const bool row = std::any_of(rows.begin(), rows.end(), [](const auto& r) { return r.name == "drop_outgoing"; });
  return {scene.sheet.total_impulse().z,
          ledger.energy_error(),
          norm(loop.momentum_everywhere() - ledger.initial_momentum()) / loop.impulse_scale(),
          sand_front_radius(scene.sand, scene.centre),
          static_cast<long>(scene.sand.size()),
          row};
}

TEST(DropOutgoing_OfSandThatFliesApart, ChangesNothingOnThePlate_AndKeepsTheBooks) {
  const Outcome off = fly_apart("off"), on = fly_apart("on");
  EXPECT_LT(on.left, off.left / 2) << "more than half of a ball flies past";
  EXPECT_LT(off.impulse, -1.0) << "N s: the plate must have been hit";
  EXPECT_NEAR(on.impulse, off.impulse, 1e-12 * std::abs(off.impulse));
  EXPECT_LT(on.energy_error, 1.01 * off.energy_error) << "of velocity Verlet, in contacts that both runs have";
  EXPECT_LT(on.momentum_error, 1e-11);
  EXPECT_GT(on.front, 0.0) << "m: of what is left";
  EXPECT_LT(on.front, off.front) << "m: what is taken out flies ahead";
  EXPECT_TRUE(on.has_row);
  EXPECT_FALSE(off.has_row);
}

}  // namespace
}  // namespace standoff::particles
