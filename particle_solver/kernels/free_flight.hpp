#pragma once
// Whether a sphere in free flight can still touch the plate or its cover: straight line x(t) = x + v t, t >= 0, over a
// surface that stays below the height `top` and inside the outline |x| <= X, |y| <= Y.
//
//   v_z >= 0:  never, if it is above top + r.
//   v_z <  0:  it comes down to top + r at t1 = (z - top - r)/(-v_z). Never, if it is then outside of the outline by
//   more
//              than r along x or y, and moves on outwards there.
//
// Exact for a sphere that nothing touches any more: elementary geometry of a straight line. Mirror planes x = 0, y = 0
// change nothing, because the outline is that of the full surface: a reflected flight is the image of the straight one.
// Not valid for a surface that rises above `top`. Symbols: x, r, top, X, Y [m], v [m/s].
#include <cmath>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

struct SurfaceReach {
  double top = 0.0;                   // m
  double half_x = 0.0, half_y = 0.0;  // m, outline with its cover
};

inline bool passes_the_surface(const Vec3& position, const Vec3& velocity, double radius, const SurfaceReach& surface) {
  const double height = position.z - surface.top - radius;
  if (height <= 0.0) return false;
  if (velocity.z >= 0.0) return true;
  const double time = height / -velocity.z;
  const auto outside = [&](double x, double v, double half) {
    const double then = x + v * time;
    return std::abs(then) > half + radius && then * v >= 0.0;
  };
  return outside(position.x, velocity.x, surface.half_x) || outside(position.y, velocity.y, surface.half_y);
}

}  // namespace standoff::particles
