#include "particle_solver/packing/cell_compression.hpp"

#include <cmath>

#include "particle_solver/step/grain_rotation.hpp"
#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles {

namespace {

CompressionPoint measure(const SandPairs& pairs, double height) {
  const SandBooks& books = pairs.books();
  return {1.0 - height, books.virial.z / height, 0.5 * (books.virial.x + books.virial.y) / height, books.coordination,
          books.friction_loss};
}

}  // namespace

std::vector<CompressionPoint> compress_cell(const PackedCell& cell, const GrainLaw& law,
                                            const CompressionOptions& options) {
  // Quasi-static: the mass only sets the time scale, so it is 1 and the step follows from k.
  SandState grains = make_grains(cell.position, cell.mean_radius, 1.0);
  grains.grain_radius = cell.radius;
  if (options.turning) let_grains_turn(grains);
  SandPairs pairs({law, {}, Vec3{1.0, 1.0, 1.0}, 0.15, options.threads, options.turning});
  pairs.forces(grains, 0.0);
  const double step = 0.2 * std::sqrt(1.0 / law.stiffness), slow = 1.0 - 0.2 * options.drag;
  double height = 1.0;
  std::vector<CompressionPoint> curve{measure(pairs, height)};
  for (int n = 1; n <= options.steps; ++n) {
    half_kick(grains, step, options.threads);
    if (options.turning) half_turn(grains, step, options.threads);
    drift(grains, step, options.threads);
    const double next = 1.0 - options.strain * n / options.steps;
    for (Vec3& p : grains.position) p.z *= next / height;
    height = next;
    pairs.set_box({1.0, 1.0, height});
    pairs.forces(grains, step);
    half_kick(grains, step, options.threads);
    if (options.turning) half_turn(grains, step, options.threads);
    for (Vec3& v : grains.velocity) v *= slow;
    for (Vec3& w : grains.spin) w *= slow;
    if (static_cast<long>(n) * options.points / options.steps >
        static_cast<long>(n - 1) * options.points / options.steps)
      curve.push_back(measure(pairs, height));
  }
  return curve;
}

}  // namespace standoff::particles
