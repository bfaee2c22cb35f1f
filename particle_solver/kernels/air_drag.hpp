#pragma once
// Drag of still air on a sphere,
//   m dv/dt = -C_D(Re) rho pi r^2 |v| v / 2,   Re = 2 rho r |v| / mu,
//   C_D = 24/Re (1 + 0.15 Re^0.687)  for Re < 1000,   0.44 above
// Source: Schiller & Naumann, Z. VDI 77 (1935) 318; the constant: Clift, Grace & Weber, Bubbles, Drops, and Particles
// (1978), ch. 5. Deviation: no rise of C_D near the speed of sound (to about 1, Henderson, AIAA J. 14 (1976) 707): at
// most a factor of two there.
//
// Over a step h with C_D held, |v| follows 1/|v|' = 1/|v| + h rho C_D pi r^2 / (2 m): exact for constant C_D, never
// turns v round, no limit of stability.
//
// Symbols: v [m/s], r [m], m [kg], rho [kg/m3] > 0, mu [Pa s] > 0, h [s].
#include <cmath>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

inline double sphere_drag_coefficient(double reynolds) {
  if (reynolds >= 1000.0) return 0.44;
  return 24.0 / reynolds * (1.0 + 0.15 * std::pow(reynolds, 0.687));
}

/// What is left of the velocity after h: a factor in (0, 1].
inline double drag_factor(double speed, double radius, double mass, double density, double viscosity, double h) {
  if (!(speed > 0.0)) return 1.0;
  const double coefficient = sphere_drag_coefficient(2.0 * density * radius * speed / viscosity);
  const double rate = 0.5 * coefficient * density * 3.141592653589793 * radius * radius / mass;  // 1/m
  return 1.0 / (1.0 + rate * speed * h);
}

}  // namespace standoff::particles
