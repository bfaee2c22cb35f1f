// Law: whatever meets whatever (products, air, dry or wet grains, the plate, its cover, mirrors, an open edge, walls,
// images),
// momentum is kept exactly by every hit and force pair: 1e-11 of the impulses exchanged (and of 1 N s, the products
// carry hundreds), some 1e5 roundings. Energy is kept exactly by hits, and by velocity Verlet and the dashpots to a few
// per mille: 1 % with grains, 1e-11 without. An exploding charge of 150 g in a box whose sides it reaches, over a plate
// that gives way.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_solver/step/time_loop.hpp"
#include "tests/unit/case_folder.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

struct Media {
  const char* soil;
  const char* air;
  const char* boundaries;
  const char* symmetry;
};
void PrintTo(const Media& m, std::ostream* out) {
  *out << m.soil << " soil, air " << m.air << ", " << m.boundaries << " box, symmetry " << m.symmetry;
}

/// A closed box ends at the cover of the plate; an open one has a plate that gas can get behind.
CaseSpec case_of(const Media& media) {
  const bool closed = std::string(media.boundaries) == "reflecting";
  standoff::test::CaseFolder folder;
  folder.write("case.toml",
               fmt::format(R"([charge]
explosive = "c4"
mass = "150 g"
radius = "28.2 mm"
particles = 800
[plate]
material = "al6xn"
size = ["100 mm", "100 mm", "3.4 mm"]
surround = "{}"
[domain]
size = ["0.3 m", "0.3 m", "0.5 m"]
boundaries = "{}"
[run]
stand_off = "100 mm"
until = "0.3 ms"
symmetry = "{}"
[soil]
kind = "{}"
inner_radius = "30 mm"
outer_radius = "76.2 mm"
particles = 2000
[air]
mode = "{}"
)",
                           closed ? "rigid" : "open", media.boundaries, media.symmetry, media.soil, media.air));
  const CaseRead read = folder.read();
  EXPECT_TRUE(read.errors.empty()) << standoff::test::all_errors(read);
  return read.spec;
}

class MediaTogether : public testing::TestWithParam<Media> {};

TEST_P(MediaTogether, KeepMomentumAndEnergy) {
  const CaseSpec spec = case_of(GetParam());
  const bool closed = std::string(GetParam().boundaries) == "reflecting",
             grains = std::string(GetParam().soil) != "none";
  const double edge = std::string(GetParam().symmetry) == "quarter" ? 0.0 : -0.05;
  const SurfaceMesh mesh = test::sheet_mesh(6, edge, 0.05, 1e-2, [](double x, double y) { return Vec3{x, y, 0.0}; });
  SurfaceMotion motion = test::at_rest(mesh);
  Scene scene = build_scene(spec, mesh, 1);
  TimeLoop loop(spec, scene, 1);
  ParticleLedger ledger;
  ledger.open(loop.energy(), loop.momentum_everywhere());
  constexpr double window = 2e-6;
  for (int k = 0; k < 60; ++k) {
    for (std::size_t n = 0; n < motion.position.size(); ++n) {
      motion.velocity[n] = {0.0, 0.0, -20.0};
      motion.position[n] = mesh.position[n] + Vec3{0.0, 0.0, -20.0 * window * k};
    }
    scene.sheet.begin_window(motion, true);
    loop.advance(window * k, window);
    ledger.observe(loop.energy());
    ASSERT_LT(norm(loop.momentum_everywhere() - ledger.initial_momentum()), 1e-11 * (1.0 + loop.impulse_scale())) << k;
  }
  EXPECT_LT(ledger.energy_error(), grains ? 0.01 : 1e-11);
  EXPECT_NE(scene.sheet.total_impulse().z, 0.0) << "the plate must have been hit";
  const ParticleEnergy books = loop.energy();
  if (!scene.has_air) {
    EXPECT_EQ(books.escaped_gas > 0.0, loop.boundary_totals().gas > 0);
  }
  EXPECT_EQ(books.escaped_air > 0.0, scene.has_air) << "also into still air";
  EXPECT_EQ(books.escaped_sand > 0.0, loop.boundary_totals().sand > 0);
  EXPECT_EQ(books.friction_loss > 0.0, spec.effect("friction"));
  EXPECT_EQ(books.damping_loss > 0.0, spec.effect("damping"));
  // Air that flies into still air is taken out too.
  if (!scene.has_air) {
    EXPECT_EQ(loop.boundary_totals().gas == 0 && loop.boundary_totals().sand == 0, closed);
  }
  EXPECT_EQ(norm(loop.boundary_books().mirror_impulse) > 0.0, closed || spec.run.quarter_symmetry);
}
INSTANTIATE_TEST_SUITE_P(
    Every, MediaTogether,
    testing::Values(Media{"none", "off", "open", "quarter"}, Media{"none", "off", "reflecting", "none"},
                    Media{"none", "on", "open", "none"}, Media{"none", "on", "reflecting", "quarter"},
                    Media{"dry", "off", "reflecting", "quarter"}, Media{"dry", "on", "open", "none"},
                    Media{"wet", "off", "open", "quarter"}, Media{"wet", "on", "reflecting", "none"},
                    Media{"dry", "on", "reflecting", "quarter"}, Media{"none", "off", "periodic", "none"},
                    Media{"dry", "on", "periodic", "none"}, Media{"wet", "off", "periodic", "none"}));

}  // namespace
}  // namespace standoff::particles
