// Products and dry grains over a moving plate: as TimeLoop composes the scene, or the stages by hand.
#include <cmath>

#include "coupling/base/state_hash.hpp"
#include "particle_solver/step/detonate.hpp"
#include "particle_solver/step/gas_drift.hpp"
#include "particle_solver/step/sand_integrate.hpp"
#include "particle_solver/step/time_loop.hpp"
#include "tests/absence/measured.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace {

using namespace standoff;
using namespace standoff::particles;

constexpr double window = 1e-6, wall_speed = -20.0;  // s, m/s
constexpr int windows = 60;

/// The plate moves by itself; `advance` does one window.
template <class Advance>
void run_windows(Scene& scene, const SurfaceMesh& mesh, const Advance& advance) {
  SurfaceMotion motion = standoff::particles::test::at_rest(mesh);
  for (int k = 0; k < windows; ++k) {
    for (std::size_t n = 0; n < motion.position.size(); ++n) {
      motion.velocity[n] = {0.0, 0.0, wall_speed};
      motion.position[n] = mesh.position[n] + Vec3{0.0, 0.0, wall_speed * window * k};
    }
    scene.sheet.begin_window(motion, true);
    advance(window * k);
  }
}

/// What a scene of products and grains needs, and nothing else: no air, no friction.
class ByHand {
 public:
  ByHand(const CaseSpec& spec, Scene& scene)
      : scene_(scene),
        gas_(gas_options(spec)),
        pairs_(frictionless(*scene.sand_law)),
        contact_(surface_contact_options(spec, scene.sand_law->law.stiffness, 1)),
        boundaries_({spec.domain.lower, spec.domain.upper, spec.run.quarter_symmetry, 1, false}) {
    gas_step_ = gas_.suggest_step(scene.gas, last_, 0.0, spec.run.until);
    pairs_.forces(scene.sand, 0.0);
  }
  void advance(double begin) {
    for (double time = begin; begin + window - time > 1e-9 * window;) {
      const double limit = std::min(pairs_.stable_step(), HardCore::longest_step(scene_.sand));
      const double left = begin + window - time, count = parts(left, limit);
      step(time, left / count);
      time = count == 1.0 ? begin + window : time + left / count;
    }
  }

 private:
  static GasCollideOptions gas_options(const CaseSpec& spec) {
    GasCollideOptions options;
    options.seed = spec.run.seed;
    options.mirrors.on = spec.run.quarter_symmetry;
    return options;
  }
  static SandPairsOptions frictionless(const SandPairsOptions& of_scene) {
    SandPairsOptions options = of_scene;
    options.law = {of_scene.law.stiffness, 0.0, 0.0};
    return options;
  }
  static double parts(double span, double limit) { return std::max(1.0, std::ceil(span / limit * (1.0 - 1e-12))); }
  void step(double time, double dt) {
    half_kick(scene_.sand, dt, 1);
    contact_.run(scene_.sand, scene_.sheet, dt);
    boundaries_.run(&scene_.gas, &scene_.sand, &scene_.sheet, books_);
    const double count = parts(dt, gas_step_), h = dt / count;
    for (double i = 0.0; i < count; ++i) {
      detonate(scene_.gas, time + i * h, &gas_.idle_grid());
      last_ = gas_.run(scene_.gas, &scene_.sand, &scene_.sheet, h, sub_steps_++);
      gas_drift(scene_.gas, &scene_.sand, &scene_.sheet, h);
    }
    gas_step_ = gas_.suggest_step(scene_.gas, last_, gas_step_, window);
    pairs_.forces(scene_.sand, dt);
    half_kick(scene_.sand, dt, 1);
    core_.run(scene_.sand, pairs_);
  }

  Scene& scene_;
  GasCollide gas_;
  GasCollideCounts last_;
  SandPairs pairs_;
  SurfaceContact contact_;
  HardCore core_;
  Boundaries boundaries_;
  BoundaryBooks books_;
  double gas_step_ = 0.0;
  std::uint32_t sub_steps_ = 0;
};

void run(const standoff::test::Order& order) {
  const SurfaceMesh mesh = standoff::particles::test::sheet_mesh(6, 0.0, 0.05, 1e-2, [](double x, double y) {
    return Vec3{x, y, 0.0};
  });
  Scene scene = build_scene(order.spec, mesh, 1);
  if (order.by_hand) {
    ByHand loop(order.spec, scene);
    measured([&] { run_windows(scene, mesh, [&](double begin) { loop.advance(begin); }); });
  } else {
    TimeLoop loop(order.spec, scene, 1);
    measured([&] { run_windows(scene, mesh, [&](double begin) { loop.advance(begin, window); }); });
  }
  StateHash hash;
  for (const auto& array : {scene.gas.position, scene.gas.velocity, scene.sand.position, scene.sand.velocity})
    hash.add(std::span<const Vec3>(array));
  hash.add(scene.sheet.total_impulse());
  std::printf("%s\n", hash.hex().c_str());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(standoff::test::order_of(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "absence_particles: %s\n", error.what());
    return 2;
  }
  return 0;
}
