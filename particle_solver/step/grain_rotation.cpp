#include "particle_solver/step/grain_rotation.hpp"

#include "particle_solver/kernels/turning_sphere.hpp"

namespace standoff::particles {

void let_grains_turn(SandState& sand) {
  sand.spin.assign(sand.size(), {}), sand.torque.assign(sand.size(), {});
}

void half_turn(SandState& sand, double dt, int threads) {
  const auto count = static_cast<long>(sand.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (long n = 0; n < count; ++n) {
    const auto i = static_cast<std::size_t>(n);
    sand.spin[i] += sand.torque[i] * (0.5 * dt / moment_of_inertia(sand.mass_of(i), sand.radius_of(i)));
  }
}

double rotation_energy(const SandState& sand, std::size_t grain) {
  return 0.5 * moment_of_inertia(sand.mass_of(grain), sand.radius_of(grain)) * squared_norm(sand.spin[grain]);
}

double rotation_energy(const SandState& sand) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sand.spin.size(); ++i) sum += rotation_energy(sand, i);
  return sum;
}

}  // namespace standoff::particles
