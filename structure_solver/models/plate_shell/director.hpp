#pragma once
// The director of a shell node from its two degrees of freedom: a rotation of any size that adds like a vector.
//   d = (t sin|t|/|t|, cos|t|),  t = (t_x, t_y)     the rotation vector is e_z x t: d leans by |t| towards t
// so no increments are composed and no rotation is stored: the force is a function of the displacements alone. The map
// is one to one for |t| < pi; a plate before a charge leans by 0.5 rad. Force on t: (dd/dt)^T times that on d.
// t is kept as slip = (h/2) t, the way of the face against the mid-surface: metres like u, its force newtons like f.
#include <cmath>

#include "coupling/base/vec3.hpp"

namespace standoff::structure {

/// sin s / s and (cos s - sin s / s) / s^2 from s^2; series below 1e-4, error 1e-16.
struct TiltFactors {
  double sinc, slope;
  static TiltFactors of(double square) {
    if (square < 1e-4)
      return {1.0 - square / 6.0 * (1.0 - square / 20.0), -1.0 / 3.0 + square / 30.0 * (1.0 - square / 28.0)};
    const double s = std::sqrt(square), sinc = std::sin(s) / s;
    return {sinc, (std::cos(s) - sinc) / square};
  }
};

/// d - e_z.
inline Vec3 director_lean(const Vec3& slip, double half_thickness) {
  const double x = slip.x / half_thickness, y = slip.y / half_thickness, square = x * x + y * y;
  const double sinc = TiltFactors::of(square).sinc, half = std::sin(0.5 * std::sqrt(square));
  return {x * sinc, y * sinc, -2.0 * half * half};
}

/// Force on the slip from the force on the director.
inline Vec3 slip_force(const Vec3& slip, const Vec3& couple, double half_thickness) {
  const double x = slip.x / half_thickness, y = slip.y / half_thickness;
  const TiltFactors f = TiltFactors::of(x * x + y * y);
  const double along = (x * couple.x + y * couple.y) * f.slope - couple.z * f.sinc;
  return {(f.sinc * couple.x + x * along) / half_thickness, (f.sinc * couple.y + y * along) / half_thickness, 0.0};
}

}  // namespace standoff::structure
