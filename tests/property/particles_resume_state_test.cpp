// Law: a particle side that is saved at the end of any window and read into a freshly built scene goes on with the same
// bits, also with another number of threads: every number that outlives a window is in the archive. Compared are the
// bytes of the whole state at the end, so no tolerance. Only the seconds of the stages differ; they are left out.
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"
#include "tests/unit/particles_side.hpp"

namespace standoff::particles {
namespace {

/// A charge in a shell of sand whose outside touches the plate: hits on the plate from the first window on.
CaseSpec buried_charge(const std::string& soil, const char* air = "off") {
  standoff::test::CaseFolder folder;
  folder.write("case.toml", R"([charge]
explosive = "c4"
mass = "150 g"
radius = "28.2 mm"
particles = 800
[plate]
material = "al6xn"
size = ["406 mm", "406 mm", "3.4 mm"]
[run]
stand_off = "76.2 mm"
until = "0.3 ms"
[soil]
)" + soil + "[air]\nmode = \"" + air +
                                "\"\n");
  const CaseRead read = folder.read();
  EXPECT_TRUE(read.errors.empty()) << standoff::test::all_errors(read);
  return read.spec;
}

constexpr const char* no_soil = "kind = \"none\"\n";
constexpr const char* dry_soil =
    "kind = \"dry\"\ninner_radius = \"30 mm\"\nouter_radius = \"76.2 mm\"\nparticles = 2000\n";
constexpr const char* wet_soil =
    "kind = \"wet\"\ninner_radius = \"30 mm\"\nouter_radius = \"76.2 mm\"\nparticles = 1000\n";

using standoff::particles::test::Side;

SurfaceMesh quarter_of_the_plate() {
  return test::sheet_mesh(8, 0.0, 0.203, 1e-2, [](double x, double y) { return Vec3{x, y, 0.0}; });
}

void expect_same_bits(const CaseSpec& spec, int stop_at, int end, int threads) {
  Side whole(spec, 1, quarter_of_the_plate());
  whole.run(0, stop_at);
  const std::string saved = whole.saved();
  whole.run(stop_at, end);
  Side resumed(spec, threads, quarter_of_the_plate());
  resumed.read(saved);
  resumed.run(stop_at, end);
  EXPECT_EQ(resumed.state() == whole.state(), true) << "stopped after " << stop_at << " windows";
  EXPECT_EQ(resumed.load.force, whole.load.force);
  EXPECT_NE(whole.scene.sheet.total_impulse().z, 0.0) << "the plate must have been hit";
}

TEST(ResumedParticles, StoppedWhileTheChargeDetonates_GoOnWithTheSameBits) {
  const CaseSpec spec = buried_charge(dry_soil);
  Side probe(spec, 1, quarter_of_the_plate());
  probe.run(0, 3);
  EXPECT_FALSE(probe.scene.gas.all_released()) << "6 us: the front is still in the charge";
  EXPECT_GT(probe.loop.totals().sub_steps, 0);
  expect_same_bits(spec, 3, 20, 2);
}

TEST(ResumedParticles, StoppedWithSlidingContacts_GoOnWithTheSameBits) {
  const CaseSpec spec = buried_charge(dry_soil);
  Side probe(spec, 1, quarter_of_the_plate());
  probe.run(0, 20);
  EXPECT_GT(probe.loop.sand_books().friction_loss, 0.0);
  EXPECT_GT(probe.loop.sand_books().elastic_energy, 0.0);
  expect_same_bits(spec, 20, 40, 2);
}

TEST(ResumedParticles, AwakeAirBesideStillAir_GoesOnWithTheSameBits) {
  const CaseSpec spec = buried_charge(dry_soil, "on");
  Side probe(spec, 1, quarter_of_the_plate());
  probe.run(0, 20);
  EXPECT_GT(probe.scene.air->particles.size(), 100u);
  expect_same_bits(spec, 20, 30, 2);
}

TEST(ResumedParticles, WetSandWithUnequalGrains_GoesOnWithTheSameBits) {
  expect_same_bits(buried_charge(wet_soil), 15, 30, 2);
}

TEST(ResumedParticles, BareChargeOnThePlate_GoesOnWithTheSameBits) {
  expect_same_bits(buried_charge(no_soil), 30, 60, 1);
}

TEST(ResumedParticles, StateOfAnotherSurface_IsRefused) {
  const CaseSpec spec = buried_charge(no_soil);
  Side side(spec, 1, quarter_of_the_plate());
  const SurfaceMesh other = test::sheet_mesh(4, 0.0, 0.203, 1e-2, [](double x, double y) { return Vec3{x, y, 0.0}; });
  Scene scene = build_scene(spec, other, 1);
  TimeLoop loop(spec, scene, 1);
  const std::string saved = side.saved();
  StateReader reader(saved);
  try {
    reader(loop);
    FAIL() << "a sheet of 81 nodes was read as one of 25";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::checkpoint_incompatible);
  }
}

}  // namespace
}  // namespace standoff::particles
