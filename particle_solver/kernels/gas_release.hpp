#pragma once
// A particle of explosive that the detonation has not reached stands still, but owns its velocity-to-be v0 and its
// internal energy: E = m v0^2 / 2 + e never changes while it waits. Gas that strikes it bounces off as off an infinite
// mass (v' = v - 2 (v.n) n), and the impulse J it takes is stored. At release
//   v = v0 + J / m,   e = E - m v^2 / 2,
// so momentum (counting m v0 + J for those that wait) and energy are exact at every moment.
//
// J could exceed what E can pay for. A hit that would bring m |v0 + J/m|^2 / 2 above 0.98 E therefore releases the
// particle first and is an ordinary collision then. Release time of the undisturbed particle: t = L / D, L its distance
// from the detonator [Borvik 2011, sec. 3.2].
//
// Symbols: m [kg], v0, v [m/s], J [N s], e, E [J].
#include <algorithm>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

inline constexpr double largest_kinetic_share_unreleased = 0.98;

struct Release {
  Vec3 velocity;                 // m/s
  double internal_energy = 0.0;  // J
};

/// True if the stored impulse would use up the particle's energy.
inline bool must_release(double mass, const Vec3& velocity, double internal_energy, const Vec3& impulse) {
  const double energy = 0.5 * mass * squared_norm(velocity) + internal_energy;
  return 0.5 * mass * squared_norm(velocity + impulse / mass) > largest_kinetic_share_unreleased * energy;
}

/// State of the particle once it moves.
inline Release release(double mass, const Vec3& velocity, double internal_energy, const Vec3& impulse) {
  Release result;
  result.velocity = velocity + impulse / mass;
  const double gain = 0.5 * mass * (squared_norm(result.velocity) - squared_norm(velocity));
  result.internal_energy = std::max(0.0, internal_energy - gain);
  return result;
}

}  // namespace standoff::particles
