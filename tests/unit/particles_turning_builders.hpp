#pragma once
// Grains that turn, without a scene around them.
#include "particle_solver/kernels/turning_sphere.hpp"
#include "particle_solver/step/grain_rotation.hpp"
#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles::test {

inline SandPairs turning_pairs(const GrainLaw& law, bool mirrors = false, int threads = 1) {
  return SandPairs({law, {mirrors}, {}, 0.0, threads, true});
}

/// One step as TimeLoop composes it.
inline void turning_step(SandState& sand, SandPairs& pairs, double dt, int threads = 1) {
  half_kick(sand, dt, threads), half_turn(sand, dt, threads);
  drift(sand, dt, threads);
  pairs.forces(sand, dt);
  half_kick(sand, dt, threads), half_turn(sand, dt, threads);
}

/// kg m2/s about the origin: that of the paths and that of the spins.
inline Vec3 angular_momentum(const SandState& sand) {
  Vec3 sum;
  for (std::size_t i = 0; i < sand.size(); ++i)
    sum += cross(sand.position[i], sand.velocity[i]) * sand.mass_of(i) +
           sand.spin[i] * moment_of_inertia(sand.mass_of(i), sand.radius_of(i));
  return sum;
}

/// Everything that is left of the energy and what was lost [J].
inline double all_energy(const SandState& sand, const SandPairs& pairs) {
  const SandBooks& b = pairs.books();
  return kinetic_energy(sand) + rotation_energy(sand) + b.elastic_energy + b.friction_loss + b.damping_loss;
}

}  // namespace standoff::particles::test
