#pragma once
// Which particles of a cell collide in a step, in a gas whose particles are points with a cross-section: direct
// simulation Monte Carlo. Candidates are drawn without looking at distances, and taken in proportion to their relative
// speed:
//   candidates among N      N (N - 1) / 2 * sigma g_max dt / V
//   candidates N with M     N M * sigma g_max dt / V
//   accepted                with probability g / g_max
//   line of centres         as hard spheres meet: cos^2 of the angle to the relative velocity uniform in (0, 1)
// Source: Bird, Molecular Gas Dynamics (1994), eqs. 11.3 and 11.5 (no time counter), 2.16 (hard spheres). The impulse
// along the line of centres is that of larsen_borgnakke.hpp, so products and air relax by one law.
//
// A particle stands for many molecules, and products and air for different masses M and m of molecules that are alike.
// Molecules of one gas in the other lose their relative motion at the rate n sigma g / 2 (each collision takes half);
// particles at n sigma' g m / (m + M). Both agree, and the momentum that passes is the same from either side, for
//   sigma' = sigma (1 + M / m) / 2,   sigma that of air with air.
// With sigma itself heavy particles of products fly through the air like shot: a blast wave with 30 % less momentum in
// the air (tests/verification/particles_gas_blast_sphere_slow_test.cpp).
// Deviation: g_max is a bound from the velocities in the cell, not a stored running maximum: no state, no bias.
//
// Symbols: sigma [m2], g [m/s], dt [s], V [m3]. Valid while a particle collides and moves less than a cell in dt;
// larger steps blur gradients over the way travelled, energy and momentum stay exact.
#include <cmath>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/vec3.hpp"

namespace standoff::particles {

inline double candidates_among(double count, double swept_volume, double cell_volume) {
  return 0.5 * count * (count - 1.0) * swept_volume / cell_volume;
}
inline double candidates_between(double count, double others, double swept_volume, double cell_volume) {
  return count * others * swept_volume / cell_volume;
}

/// sigma' [m2] of air particles of mass `air` with products of mass `products`.
inline double unlike_cross_section(double sigma, double air, double products) {
  return 0.5 * sigma * (1.0 + products / air);
}

/// Unit vector n with closing . n < 0 for two hard spheres that meet with relative velocity `closing` = v_j - v_i != 0.
inline Vec3 random_line_of_centres(const Vec3& closing, CounterRandom& random) {
  const Vec3 along = closing / -norm(closing);
  const double cosine = std::sqrt(random.uniform()), sine = std::sqrt(1.0 - cosine * cosine);
  const double angle = 6.283185307179586 * random.uniform();
  // Any two directions across: the smaller component of `along` never degenerates.
  const Vec3 other = std::abs(along.x) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  Vec3 a = cross(along, other);
  a *= 1.0 / norm(a);
  const Vec3 b = cross(along, a);
  return along * cosine + a * (sine * std::cos(angle)) + b * (sine * std::sin(angle));
}

/// Index in [0, count) from a uniform number.
inline std::size_t pick(std::size_t count, CounterRandom& random) {
  const auto k = static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
  return k < count ? k : count - 1;
}

}  // namespace standoff::particles
