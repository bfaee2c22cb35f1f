#pragma once
// When two spheres on straight paths touch. The gap vector is r(s) = x_j(s) - x_i(s) = r0 + w s with w = v_j - v_i, and
// the centres are a contact distance D apart when
//   |r0 + w s|^2 = D^2        a s'^2 + 2 b s' + c = 0,  s' = s - from,
//   a = w.w,  b = r(from).w,  c = r(from).r(from) - D^2.
// An approaching pair (b < 0) that is apart (c > 0) touches first at s' = c / (-b + sqrt(b^2 - a c)); this form of the
// root has no cancellation for a slow approach [Press et al., Numerical Recipes, 3rd ed., sec. 5.6].
//
// An approaching pair that overlaps already (c <= 0) touches now. A pair that moves apart never touches, however deep
// it overlaps; so a pair that has just been given a separating velocity cannot fire a second time from rounding. A path
// that only grazes (discriminant zero) transfers nothing and is no hit.
//
// Symbols: gap r0 [m], closing w [m/s], distance D > 0 [m], from <= until [s]. No stability limit: exact for any step.
// Exchanging the two spheres gives the same bits, because every product is even in the sign.
#include <cmath>
#include <limits>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

inline constexpr double no_impact = std::numeric_limits<double>::infinity();

/// First time in [from, until] at which the centres are `distance` apart while approaching; no_impact if there is none.
inline double impact_time(const Vec3& gap, const Vec3& closing, double distance, double from, double until) {
  const Vec3 r = gap + closing * from;
  const double b = dot(r, closing);
  if (!(b < 0.0)) return no_impact;
  const double c = squared_norm(r) - distance * distance;
  if (c <= 0.0) return from;
  const double discriminant = b * b - squared_norm(closing) * c;
  if (!(discriminant > 0.0)) return no_impact;
  const double time = from + c / (std::sqrt(discriminant) - b);
  return time <= until ? time : no_impact;
}

/// First time in [from, until] at which a centre at x + v s is `distance` or less above a fixed plane at 0 while moving
/// towards it; no_impact if there is none.
inline double plane_impact_time(double x, double v, double distance, double from, double until) {
  if (!(v < 0.0)) return no_impact;
  const double time = (distance - x) / v;
  if (time <= from) return from;
  return time <= until ? time : no_impact;
}

}  // namespace standoff::particles
