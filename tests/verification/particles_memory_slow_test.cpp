// Limits: below 150 bytes a particle of products or air and below 400 a grain, with all that the run keeps and builds
// for them: state, lists, springs, searches, at the peak of the steps. Counted by the allocator of this program. A
// scene is run at two sizes: the difference of the peaks over the difference in
// particles is what a particle takes, without what every scene takes (surface, maps, scratch of a thread).
//
// Tolerances: the limits are limits. The plan's bytes are those of the worst moment of a dry scene, when the shock has
// pressed most grains together; contacts vary by a fifth between sizes and moments, and they are a quarter of the
// bytes: 10 %.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>
#include <malloc.h>

#include "coupling/case/particle_bytes.hpp"
#include "particle_solver/step/time_loop.hpp"
#include "tests/unit/case_folder.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace {

std::atomic<long> live{0}, peak{0};

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  const long now = live += static_cast<long>(malloc_usable_size(memory));
  if (now > peak) peak = now;
  return memory;
}
void give_back(void* memory) {
  if (memory != nullptr) live -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void* operator new(std::size_t size) {
  return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto edge = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(edge, (size + edge - 1) / edge * edge));
}
void operator delete(void* memory) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  give_back(memory);
}
#endif

namespace standoff::particles {
namespace {

struct Use {
  double gas = 0.0, air = 0.0, grains = 0.0, bytes = 0.0;  // most particles; peak of the steps
};

/// Runs a case of the reference system without symmetry until `until` in windows of 1 us.
Use use_of(const std::string& name, long charge, long soil, long air, double until) {
  CaseOverrides overrides;
  overrides.level = "coarse";
  overrides.set = {{"run.symmetry", "none"}, {"charge.particles", std::to_string(charge)}};
  if (soil > 0) overrides.set.emplace_back("soil.particles", std::to_string(soil));
  overrides.set.emplace_back("air.mode", air > 0 ? "on" : "off");
  if (air > 0) overrides.set.emplace_back("air.particles", std::to_string(air));
  if (air > 0) overrides.set.emplace_back("domain.size", R"(["640 mm", "640 mm", "400 mm"])");
  const CaseRead read = read_case(std::string(STANDOFF_SOURCE_DIR "/cases/borvik_2011/") + name, overrides);
  EXPECT_TRUE(read.errors.empty()) << standoff::test::all_errors(read);
  const SurfaceMesh mesh = test::sheet_mesh(20, -0.15, 0.15, 1e-2, [](double x, double y) { return Vec3{x, y, 0.0}; });
  const SurfaceMotion motion = test::at_rest(mesh);
  const long before = live;
  Scene scene = build_scene(read.spec, mesh, 1);
  peak = live.load();
  TimeLoop loop(read.spec, scene, 1);
  SurfaceLoad load;
  Use use;
  const double window = 1e-6;
  for (double time = 0.0; time < until; time += window) {
    scene.sheet.begin_window(motion, true);
    loop.advance(time, window);
    scene.sheet.collect_load(window, load);
    if (scene.has_air) use.air = std::max(use.air, static_cast<double>(scene.air->particles.size()));
  }
  use.bytes = static_cast<double>(peak - before);
  use.gas = static_cast<double>(scene.gas.size()), use.grains = static_cast<double>(scene.sand.size());
  return use;
}

class Memory : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer has an allocator of its own";
#endif
  }
};

/// Bytes a grain; the products beside it at the plan's price. From 50000 grains on blocks are full, so that the scratch
/// of a thread no longer grows with the scene.
double bytes_of_a_grain(const std::string& name, long soil, double until) {
  const Use one = use_of(name, soil / 5, soil, 0, until), two = use_of(name, 2 * (soil / 5), 2 * soil, 0, until);
  return (two.bytes - one.bytes - gas_bytes * (two.gas - one.gas)) / (two.grains - one.grains);
}

TEST_F(Memory, ProductsFromIgnitionToTheFreeCloud_TakeLessThan150BytesAParticle) {
  // Powers of two are where the table of cells is largest against the number of particles.
  const Use one = use_of("bare_150mm", 16384, 0, 0, 10e-6), two = use_of("bare_150mm", 32768, 0, 0, 10e-6);
  const double bytes = (two.bytes - one.bytes) / (two.gas - one.gas);
  EXPECT_LT(bytes, 150.0);
  EXPECT_NEAR(bytes, gas_bytes, 0.1 * gas_bytes);
}

TEST_F(Memory, AwakeAir_TakesLessThan150BytesAParticle) {
  // A box small enough to be awake for the most part: cells of still air take some bytes each. The small scene is much
  // smaller, because only one of the two may have been caught while an array moves to a larger place.
  const Use one = use_of("bare_150mm", 1000, 0, 50000, 100e-6), two = use_of("bare_150mm", 1000, 0, 1000000, 100e-6);
  const double bytes = (two.bytes - one.bytes) / (two.air - one.air);
  EXPECT_GT(two.air - one.air, 20000.0);
  EXPECT_LT(bytes, 150.0);
  EXPECT_NEAR(bytes, air_bytes, 0.1 * air_bytes);
}

TEST_F(Memory, DrySandInTheShock_TakesLessThan400BytesAGrain) {
  const double bytes = bytes_of_a_grain("dry_150mm", 50000, 30e-6);
  EXPECT_LT(bytes, 400.0);
  EXPECT_NEAR(bytes, grain_bytes + history_bytes, 0.1 * bytes);
}

TEST_F(Memory, WetSandInTheShock_TakesLessThan400BytesAGrain) {
  const double bytes = bytes_of_a_grain("wet_150mm", 50000, 10e-6);
  EXPECT_LT(bytes, 400.0);
  EXPECT_NEAR(bytes, grain_bytes, 0.1 * bytes);
}

}  // namespace
}  // namespace standoff::particles
