#pragma once
// Hard core of two grains: where the linear spring is pressed beyond half a radius it no longer stops what approaches,
// and grains would pass through each other. There the approach is turned round at once, elastically.
//
//   core:    |d| < (1 - depth/2) reach,  d = x_i - x_j, reach = r_i + r_j,  depth = 1/2 of the mean radius of the pair
//   impulse: J = -2 m_red (v . n) n on i, -J on j, if v . n < 0;  v = v_i - v_j, n = d/|d|, 1/m_red = 1/m_i + 1/m_j
//
// The elastic impact of smooth spheres: rigid bodies with e = 1, e.g. Goldsmith, Impact (1960).
// Momentum is exact, since J acts with both signs; energy, since (v . n) only changes its sign. Where the grains are
// does not change, so the spring keeps what it has stored, pushes on, and gives it back as they part. The dashpot, if
// there is one, works on the way in and out; what it would have taken deeper than the core is left out (an e of 0.97
// becomes at most 1 for that part of the way).
//
// When a scene needs it: a linear spring is pressed by v (m/2k)^(1/2) [energy of the pair, m_red = m/2]; see the effect
// hard_core. Range: depth 0..2 radii; a pair must not cross from outside the core beyond its centre within a step, see
// step/hard_core.hpp. Units: m, m/s, kg, N s.
#include "coupling/base/vec3.hpp"

namespace standoff::particles {

/// Overlap, in mean radii of a pair, from which the core acts.
inline constexpr double hard_core_depth = 0.5;
/// The same as centre distance over reach.
inline constexpr double hard_core_share = 1.0 - 0.5 * hard_core_depth;

/// Impulse on i [N s]; zero for a pair that parts, or whose centres coincide. `inverse_masses` = 1/m_i + 1/m_j.
inline Vec3 hard_core_impulse(const Vec3& separation, const Vec3& velocity, double inverse_masses) {
  const double square = squared_norm(separation), along = dot(separation, velocity);
  if (!(along < 0.0) || square == 0.0) return {};
  return separation * (-2.0 * along / (square * inverse_masses));
}

}  // namespace standoff::particles
