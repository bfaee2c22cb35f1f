#pragma once
// A gas at rest in equilibrium: what a volume of it holds and what crosses a plane in it, so that a region that is not
// simulated can stand beside one that is.
//
//   component velocity       normal, standard deviation s = sqrt(p / rho)
//   crossing a plane         n s / sqrt(2 pi) particles per area and time; normal velocity s sqrt(-2 ln u), tangential
//                            normal
//   internal energy          Gamma(zeta / 2) m s^2: exponential for zeta = 2 (gamma = 1.4)
//   mean free path           lambda = 1 / (sqrt(2) sigma n), sigma the cross-section of hard spheres
// Source: Bird, Molecular Gas Dynamics (1994), eqs. 4.13, 4.22 (flux at rest), 4.52 (free path), app. C (sampling).
//
// Symbols: p [Pa] > 0, rho [kg/m3] > 0, n particles [1/m3], m [kg], lambda [m]. Exact for any values; no stability
// limit.
#include <cmath>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/gamma_variate.hpp"

namespace standoff::particles {

struct AmbientGas {
  double pressure = 0.0, density = 0.0;                                   // Pa, kg/m3
  double particle_mass = 0.0;                                             // kg
  double zeta = 0.0;                                                      // internal degrees of freedom
  double thermal_speed() const { return std::sqrt(pressure / density); }  // m/s, of one component
  double number_density() const { return density / particle_mass; }       // 1/m3
};

/// Particles that cross a plane per area and time in one direction, 1/(m2 s).
inline double one_way_flux(const AmbientGas& gas) {
  return gas.number_density() * gas.thermal_speed() * 0.3989422804014327;  // 1 / sqrt(2 pi)
}

inline double cross_section(const AmbientGas& gas, double mean_free_path) {
  return 1.0 / (1.4142135623730951 * gas.number_density() * mean_free_path);
}

inline Vec3 maxwell_velocity(const AmbientGas& gas, CounterRandom& random) {
  const double s = gas.thermal_speed();
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return {s * x, s * y, s * z};
}

/// Velocity of a particle that crosses a plane in the direction of positive `axis` (0 x, 1 y, 2 z) times `sign`.
inline Vec3 crossing_velocity(const AmbientGas& gas, int axis, double sign, CounterRandom& random) {
  const double s = gas.thermal_speed();
  const double normal = sign * s * std::sqrt(-2.0 * std::log(random.uniform()));
  const double a = s * random.normal(), b = s * random.normal();
  if (axis == 0) return {normal, a, b};
  if (axis == 1) return {b, normal, a};
  return {a, b, normal};
}

/// J
inline double equilibrium_internal_energy(const AmbientGas& gas, CounterRandom& random) {
  const double kt = gas.particle_mass * gas.pressure / gas.density;
  if (gas.zeta == 0.0) return 0.0;
  if (gas.zeta == 2.0) return -kt * std::log(random.uniform());
  return kt * gamma_variate(0.5 * gas.zeta, random);
}

/// A whole number whose mean is `expected`.
inline long whole_with_mean(double expected, CounterRandom& random) {
  return static_cast<long>(std::floor(expected + random.uniform()));
}

}  // namespace standoff::particles
