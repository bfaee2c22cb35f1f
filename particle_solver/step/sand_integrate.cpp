#include "particle_solver/step/sand_integrate.hpp"

#include <numeric>

namespace standoff::particles {

void half_kick(SandState& sand, double dt, int threads) {
  const auto count = static_cast<long>(sand.size());
  Vec3* velocity = sand.velocity.data();
  const Vec3* force = sand.force.data();
  if (sand.grain_mass.empty()) {
    const double scale = 0.5 * dt / sand.mass;
#pragma omp parallel for schedule(static) num_threads(threads)
    for (long i = 0; i < count; ++i) velocity[i] += scale * force[i];
    return;
  }
  const double* mass = sand.grain_mass.data();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (long i = 0; i < count; ++i) velocity[i] += (0.5 * dt / mass[i]) * force[i];
}

void drift(SandState& sand, double dt, int threads) {
  const auto count = static_cast<long>(sand.size());
  Vec3* position = sand.position.data();
  const Vec3* velocity = sand.velocity.data();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (long i = 0; i < count; ++i) position[i] += dt * velocity[i];
}

void sand_step(SandState& sand, SandPairs& pairs, double dt, int threads) {
  half_kick(sand, dt, threads);
  drift(sand, dt, threads);
  pairs.forces(sand, dt);
  half_kick(sand, dt, threads);
}

double kinetic_energy(const SandState& sand) {
  double sum = 0.0;
  for (std::size_t i = 0; i < sand.size(); ++i) sum += 0.5 * sand.mass_of(i) * squared_norm(sand.velocity[i]);
  return sum;
}

Vec3 momentum(const SandState& sand) {
  Vec3 sum;
  for (std::size_t i = 0; i < sand.size(); ++i) sum += sand.mass_of(i) * sand.velocity[i];
  return sum;
}

SandState make_grains(std::vector<Vec3> positions, double radius, double mass) {
  SandState sand;
  sand.radius = radius, sand.mass = mass;
  sand.position = std::move(positions);
  const std::size_t count = sand.position.size();
  sand.velocity.resize(count), sand.force.resize(count);
  sand.id.resize(count);
  std::iota(sand.id.begin(), sand.id.end(), 0u);
  return sand;
}

}  // namespace standoff::particles
