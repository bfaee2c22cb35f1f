// Law: in a scene that repeats across x and y nobody leaves there and no wall takes anything, so the books know of no
// exit, no mirror and no change of momentum: 1e-11 of the impulses exchanged, as in particles_media_books_test.cpp. The
// place of the scene in its period means nothing: moved sideways over a wall that does not give way, it goes through
// the same history. Rounding differs (2^-53 of 0.3 m against free paths of some mm: 1e-14 of a radius); every hit
// multiplies it by the free path over the radius, some 10, and in 4 us nobody is hit more than six times: 1e-8 of a
// velocity. The hard core is left out: a grain in two deep contacts is hit in the order of the lists, which is one of
// places.
// Threads and a stop change no bit.
#include <gtest/gtest.h>

#include "tests/unit/particles_periodic_case.hpp"
#include "tests/unit/particles_side.hpp"

namespace standoff::particles {
namespace {

using standoff::particles::test::periodic_case;
using standoff::particles::test::Side;

const std::string with_air = "[air]\nmode = \"on\"\n";

SurfaceMesh plate() {
  return test::flat_mesh(4, 0.05, 1e-2);
}
bool inside(const std::vector<Vec3>& positions) {
  return std::all_of(positions.begin(), positions.end(),
                     [](const Vec3& x) { return std::abs(x.x) <= 0.125 && std::abs(x.y) <= 0.125; });
}

class PeriodicScene : public testing::TestWithParam<std::string> {};

TEST_P(PeriodicScene, ProductsThatFlyThreePeriodsFar_LeaveNothingInTheBooks) {
  const CaseSpec spec = periodic_case(GetParam());
  Side side(spec, 1, plate());
  const Vec3 before = side.loop.momentum_everywhere();
  side.run(0, 40);
  EXPECT_LT(norm(side.loop.momentum_everywhere() - before), 1e-11 * (1.0 + side.loop.impulse_scale()));
  EXPECT_TRUE(inside(side.scene.gas.position) && inside(side.scene.sand.position));
  EXPECT_EQ(side.loop.boundary_totals().gas + side.loop.boundary_totals().sand, 0);
  EXPECT_EQ(side.loop.energy().escaped(), 0.0);
  EXPECT_EQ(norm(side.loop.boundary_books().mirror_impulse), 0.0);
  EXPECT_NE(side.scene.sheet.total_impulse().z, 0.0) << "the plate must have been hit";
}

TEST_P(PeriodicScene, WithAir_ThreadsAndAStopChangeNoBit) {
  const CaseSpec spec = periodic_case(GetParam(), with_air);
  Side whole(spec, 1, plate());
  whole.run(0, 10);
  const std::string saved = whole.saved();
  whole.run(10, 15);
  EXPECT_TRUE(inside(whole.scene.air->particles.position));
  Side resumed(spec, 2, plate());
  resumed.read(saved);
  resumed.run(10, 15);
  EXPECT_TRUE(resumed.state() == whole.state());
}
INSTANTIATE_TEST_SUITE_P(Soils, PeriodicScene, testing::Values("none", "dry", "wet"));

/// A gram of products in a narrow scene: thin after 0.1 ms, they would take steps of a fifth of the period and more.
TEST(PeriodicScene, ThinGas_DoesNotFlyToItsOwnImageInAStep) {
  const CaseSpec spec = periodic_case("none", "", {{"charge.mass", "1 g"}, {"charge.radius", "5.5 mm"}});
  Side side(spec, 1, plate());
  for (int k = 0; k < 12; ++k) side.loop.advance(20e-6 * k, 20e-6);
  double fastest = 0.0;
  for (const Vec3& v : side.scene.gas.velocity) fastest = std::max(fastest, norm(v));
  // An eighth of the period, and a fifth of that for hits that made somebody faster within the step.
  EXPECT_LT(side.loop.totals().step * fastest, 1.2 * 0.125 * 0.25);
}

TEST(PeriodicScene, MovedOverItsFaces_GoesThroughTheSameHistory) {
  for (const std::string soil : {"none", "dry"}) {
    const CaseSpec spec = periodic_case(
        soil, "[effects]\nsurface_recession = \"off\"\ndetonation_timing = \"off\"\nhard_core = \"off\"\n");
    const PeriodicSides sides = periodic_sides(true, spec.domain.lower, spec.domain.upper);
    const Vec3 by{0.11, 0.07, 0.0};
    const auto press = [](Scene& scene) {  // all grains towards the axis, so that they touch wherever they are
      for (std::size_t i = 0; i < scene.sand.size(); ++i)
        scene.sand.velocity[i] = Vec3{scene.sand.position[i].x, scene.sand.position[i].y, 0.0} * -2e3;
    };
    const auto move = [&](Scene& scene) {
      press(scene);
      for (Vec3& x : scene.gas.position) x = image_inside(sides, x + by);
      for (Vec3& x : scene.sand.position) x = image_inside(sides, x + by);
    };
    Side here(spec, 1, plate(), press), there(spec, 1, plate(), move);
    here.run(0, 2), there.run(0, 2);
    double worst = 0.0, fastest = 0.0;
    const auto compare = [&](const auto& a, const auto& b) {
      std::vector<std::uint32_t> place(a.size());
      for (std::uint32_t i = 0; i < a.size(); ++i) place[a.id[i]] = i;
      for (std::size_t i = 0; i < b.size(); ++i) {
        worst = std::max(worst, norm(b.velocity[i] - a.velocity[place[b.id[i]]]));
        fastest = std::max(fastest, norm(b.velocity[i]));
      }
    };
    compare(here.scene.gas, there.scene.gas), compare(here.scene.sand, there.scene.sand);
    EXPECT_LT(worst, 1e-8 * fastest) << soil << " soil";
    EXPECT_GT(there.loop.totals().sub_steps, 20);
    if (there.scene.has_sand) {
      EXPECT_GT(there.loop.sand_books().max_overlap_over_radius, 0.01);
    }
  }
}

}  // namespace
}  // namespace standoff::particles
