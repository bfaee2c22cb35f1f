#pragma once
// Planes across the axes that mirror the centres of particles: the symmetry planes of a quarter model, the walls of a
// closed box. A specular, elastic wall: the normal velocity turns round, v' = v - 2 (v.n) n, and the wall takes
// J = 2 m (v.n) n. Source: any text on kinetic theory, e.g. Bird, Molecular Gas Dynamics (1994), sec. 4.5 (specular).
//
// A particle that is beyond a plane (rounding) is turned round when it flies farther out. Absent planes lie at
// infinity. Symbols: x, lower, upper [m], v [m/s], times [s]. Exact for any step.
#include <limits>

#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/gas_impact_time.hpp"

namespace standoff::particles {

struct ReflectingPlanes {
  static constexpr double none = std::numeric_limits<double>::infinity();
  bool on = false;
  Vec3 lower{-none, -none, -none}, upper{none, none, none};  // m
};

/// The walls of the box, or of nothing, and with `quarter` the mirrors x = 0 and y = 0.
inline ReflectingPlanes reflecting_planes(bool quarter, bool box, const Vec3& lower, const Vec3& upper) {
  ReflectingPlanes planes;
  planes.on = quarter || box;
  if (box) planes.lower = lower, planes.upper = upper;
  if (quarter) planes.lower.x = planes.lower.y = 0.0;
  return planes;
}

struct PlaneHit {
  double time = no_impact;  // s
  unsigned axis = 0;        // 0 x, 1 y, 2 z
};

/// First time in [from, until] at which a centre at x + v s meets a plane from inside.
inline PlaneHit first_plane(const ReflectingPlanes& planes, const Vec3& x, const Vec3& v, double from, double until) {
  PlaneHit hit;
  const auto look = [&](unsigned axis, double place, double speed, double low, double high) {
    const double time = speed < 0.0 ? plane_impact_time(place, speed, low, from, until)
                                    : plane_impact_time(-place, -speed, -high, from, until);
    if (time < hit.time) hit = {time, axis};
  };
  look(0, x.x, v.x, planes.lower.x, planes.upper.x);
  look(1, x.y, v.y, planes.lower.y, planes.upper.y);
  look(2, x.z, v.z, planes.lower.z, planes.upper.z);
  return hit;
}

/// v' - v at a plane across `axis`.
inline Vec3 change_at_plane(const Vec3& v, unsigned axis) {
  if (axis == 0) return {-2.0 * v.x, 0.0, 0.0};
  return axis == 1 ? Vec3{0.0, -2.0 * v.y, 0.0} : Vec3{0.0, 0.0, -2.0 * v.z};
}

}  // namespace standoff::particles
