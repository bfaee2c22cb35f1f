#pragma once
// A particle of explosive that the detonation has not reached stands still, but owns its velocity-to-be v0 and its
// internal energy: E = m v0^2 / 2 + e. Its time of release is t = L / D, L its distance from the detonator [Borvik
// 2011, sec. 3.2], whatever struck it. Until then it answers gas that strikes it as a cold particle of the same mass at
// rest, by the law of every other hit (larsen_borgnakke.hpp), and keeps what it takes instead of moving: the impulse J
// in store, the energy J^2 / 2m of the motion it is denied and its share of the internal energy in e. A wall that takes
// no energy, the other reading of "stands still", drives the products back: on a rigid plate 8 % more impulse from
// `c4`, 38 % from the literal constants, than from a charge that goes off at once; this rule gives 4 and 13 %.
//
// When its time has come
//   v = s (v0 + J / m),   e = E - m v^2 / 2,   s = min(1, sqrt(E / (m |v0 + J / m|^2 / 2))),
// and what its energy cannot carry, (1 - s) (m v0 + J), is handed to particles beside it that still wait, ahead of the
// front: the impulse of the products travels with the front. So momentum (counting m v0 + J for those that wait) and
// energy are exact at every moment, and nothing is released early. s is a rule of ours; that the mean impulse can be
// carried follows from the detonation itself, whose products move at D / (gamma + 1), a share (gamma - 1) / (gamma + 1)
// of the energy of reaction D^2 / 2 (gamma^2 - 1) [Fickett & Davis, Detonation, 1979, sec. 2C].
//
// Where nobody near waits any more, a group of n particles already released takes the rest R: all get R / (n m), and
// the energy for it comes from the motion relative to the group's mean V and from the reservoirs, both scaled by
//   f = 1 - (R.V + R^2 / (2 n m)) / E_thermal,   E_thermal = sum m |v - V|^2 / 2 + sum e;   f > 0 is needed.
//
// Symbols: m [kg], v0, v, V [m/s], J, R [N s], e, E [J]. No stability limit.
#include <algorithm>
#include <cmath>

#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/gas_pair_impulse.hpp"
#include "particle_solver/kernels/larsen_borgnakke.hpp"

namespace standoff::particles {

struct Absorbed {
  double impulse = 0.0;      // N s on the waiting particle, along the line of centres from the striker
  double energy = 0.0;       // J, what it takes
  double energy_left = 0.0;  // J, internal energy of the striker afterwards
};

/// A hit at normal speed `approach` > 0 of a particle with internal energy `own` and zeta internal degrees of freedom.
/// The explosive has two where the gas has none: an elastic hit would leave the striker at rest in a corner of waiting
/// particles, with hits without end.
inline Absorbed strike_waiting(double mass, double approach, double own, double zeta, CounterRandom& random) {
  const double mu = 0.5 * mass, store = zeta > 0.0 ? zeta : 2.0;
  const EnergyExchange after = larsen_borgnakke_unlike(mu, -approach, own, 0.0, zeta, store, random);
  const double impulse = pair_impulse(mu, -approach, after.normal_velocity);
  return {impulse, after.energy_j + 0.5 * impulse * impulse / mass, after.energy_i};
}

struct Release {
  Vec3 velocity;                 // m/s
  double internal_energy = 0.0;  // J
  Vec3 handed_on;                // N s, what the particle's energy cannot carry
};

/// State of the particle once it moves.
inline Release release(double mass, const Vec3& velocity, double internal_energy, const Vec3& impulse) {
  const double energy = 0.5 * mass * squared_norm(velocity) + internal_energy;
  const Vec3 wanted = velocity * mass + impulse;
  const double needed = 0.5 * squared_norm(wanted) / mass;
  Release result;
  result.velocity = wanted / mass;
  if (needed > energy) {
    result.velocity *= std::sqrt(energy / needed);
    result.handed_on = wanted - result.velocity * mass;
  }
  result.internal_energy = std::max(0.0, energy - 0.5 * mass * squared_norm(result.velocity));
  return result;
}

/// f: what is left of the thermal energy of a group of mass `group` and mean velocity V that takes the impulse R.
inline double thermal_share_left(double group, const Vec3& mean, const Vec3& rest, double thermal) {
  const double price = dot(rest, mean) + 0.5 * squared_norm(rest) / group;
  return thermal > 0.0 ? 1.0 - price / thermal : 0.0;
}

}  // namespace standoff::particles
