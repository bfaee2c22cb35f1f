#pragma once
// Frictionless impact of two spheres: the impulse acts along the line of centres n (from i to j) and takes the normal
// component of the relative velocity v_n = (v_j - v_i).n from its value before (< 0, approaching) to a value v_n' > 0
// after:
//   J = mu (v_n' - v_n),   mu = 1 / (1/m_i + 1/m_j),   v_i -= J n / m_i,   v_j += J n / m_j.
// Elastic spheres: v_n' = -v_n, so J = -2 mu v_n. Momentum is exact to rounding for any v_n'; kinetic energy changes by
// mu (v_n'^2 - v_n^2) / 2. An infinite mass is written as inverse mass 0.
// Source: any text on mechanics, e.g. Goldsmith, Impact, Edward Arnold 1960, sec. 2.1.
//
// A hit at time t of the sub-step also moves the virtual starting point, x -= (v_new - v_old) t, so that the place of
// the impact is unchanged and x + v h is where the particle ends (state/media.hpp).
//
// Symbols: inverse masses [1/kg], velocities [m/s], gap = x_j - x_i at the impact [m], J [N s].
#include <cmath>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

/// Unit vector from i to j; for coincident centres, which have none, the direction against the approach.
inline Vec3 line_of_centres(const Vec3& gap, const Vec3& closing) {
  const double length = norm(gap);
  if (length > 0.0) return gap / length;
  const double speed = norm(closing);
  return speed > 0.0 ? closing / -speed : Vec3{1.0, 0.0, 0.0};
}

inline double reduced_mass(double inverse_mass_i, double inverse_mass_j) {
  return 1.0 / (inverse_mass_i + inverse_mass_j);
}

/// Impulse on j along n that leaves the pair with normal relative velocity `after`.
inline double pair_impulse(double mu, double before, double after) {
  return mu * (after - before);
}

/// Gives a body on a virtual path a new velocity at time t.
inline void change_velocity(Vec3& start, Vec3& velocity, const Vec3& change, double t) {
  velocity += change;
  start -= change * t;
}

}  // namespace standoff::particles
