#pragma once
// A scene that repeats: beside every body stand its images, one length L of the scene away in each direction. Of two
// bodies the nearest images meet, the others are too far away [Allen & Tildesley, Computer Simulation of Liquids, 2nd
// ed. (2017), sec. 1.6.3, minimum image]:
//   gap' = gap - L round(gap / L)
//   x' = x - L floor((x - x0) / L)       what leaves through a face comes in again opposite
// Both images of a pair see the same gap with opposite signs, bit by bit, because rounding to the nearest is odd.
//
// Symbols: gap, L, x, lower corner x0 [m]. A length of 0: the scene does not repeat along that axis, and gap and x stay
// as they are. Valid while no two bodies that may meet are farther apart than L / 2 beside the way they move meanwhile.
#include <algorithm>
#include <cmath>

#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/reflecting_planes.hpp"

namespace standoff::particles {

/// To the nearest whole number, ties to even, |x| < 2^51.
inline double nearest_whole(double x) {
  constexpr double magic = 0x1.8p52;
  return (x + magic) - magic;
}

/// Lengths after which a scene repeats; 0: it does not.
struct Period {
  Vec3 length, per_length;  // m, 1/m
  bool on() const { return length != Vec3{}; }
  double shortest() const;
};
inline Period period_of(const Vec3& length) {
  const auto inverse = [](double l) { return l > 0.0 ? 1.0 / l : 0.0; };
  return {length, {inverse(length.x), inverse(length.y), inverse(length.z)}};
}

/// Of the lengths along which it repeats.
inline double Period::shortest() const {
  double least = ReflectingPlanes::none;
  for (const double l : {length.x, length.y, length.z})
    if (l > 0.0) least = std::min(least, l);
  return least;
}

inline Vec3 nearest_image(Vec3 gap, const Period& period) {
  gap.x -= period.length.x * nearest_whole(gap.x * period.per_length.x);
  gap.y -= period.length.y * nearest_whole(gap.y * period.per_length.y);
  gap.z -= period.length.z * nearest_whole(gap.z * period.per_length.z);
  return gap;
}
/// The gap itself, or the one between nearest images.
template <bool Periodic>
Vec3 nearest_image(const Vec3& gap, const Period& period) {
  if constexpr (Periodic) return nearest_image(gap, period);
  return gap;
}

/// The image of x in [lower, lower + length], rounding at the faces included.
inline double image_inside(double x, double lower, double length, double per_length) {
  return std::max(lower, x - length * std::floor((x - lower) * per_length));
}

/// A scene that repeats across x and y and is open, or ends at a plate, across z.
struct PeriodicSides {
  ReflectingPlanes faces;  // where a centre comes back from the opposite side; none across z
  Period period;
  bool on() const { return period.on(); }
};
inline PeriodicSides periodic_sides(bool on, const Vec3& lower, const Vec3& upper) {
  PeriodicSides sides;
  if (!on) return sides;
  sides.faces.on = true;
  sides.faces.lower.x = lower.x, sides.faces.lower.y = lower.y;
  sides.faces.upper.x = upper.x, sides.faces.upper.y = upper.y;
  sides.period = period_of({upper.x - lower.x, upper.y - lower.y, 0.0});
  return sides;
}

/// The image of a point between the faces.
inline Vec3 image_inside(const PeriodicSides& sides, Vec3 x) {
  const Vec3 &lower = sides.faces.lower, &length = sides.period.length, &inverse = sides.period.per_length;
  x.x = image_inside(x.x, lower.x, length.x, inverse.x);
  x.y = image_inside(x.y, lower.y, length.y, inverse.y);
  return x;
}

/// x' - x of a centre that flies out with velocity v through a face across `axis`.
inline Vec3 shift_at_face(const PeriodicSides& sides, const Vec3& v, unsigned axis) {
  const Vec3& length = sides.period.length;
  if (axis == 0) return {-std::copysign(length.x, v.x), 0.0, 0.0};
  return {0.0, -std::copysign(length.y, v.y), 0.0};
}

}  // namespace standoff::particles
