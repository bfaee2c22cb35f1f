#pragma once
// Exchange of energy between the normal relative motion of two colliding particles and their internal reservoirs, so
// that a gas of spheres has a ratio of specific heats below 5/3. The impulse stays central, hence angular momentum is
// kept too.
//
//   E    = mu v_n^2 / 2 + e_i + e_j                          energy that takes part, kept exactly
//   E_n' = E (1 - (1 - u)^(1/zeta)),   u uniform in (0,1)    E_n'/E ~ Beta(1, zeta)
//   e_i' : e_j' = B : 1 - B of the rest,  B ~ Beta(zeta/2, zeta/2)
//   v_n' = sqrt(2 E_n' / mu) > 0                             the pair separates
//
// Why these distributions: among colliding pairs in equilibrium v_n has the density v_n exp(-mu v_n^2 / 2kT), so E_n is
// exponential (Gamma, shape 1); zeta internal degrees of freedom give each reservoir Gamma(zeta/2), the pair
// Gamma(zeta). Given their sum, the parts of independent Gammas are Beta distributed: detailed balance. Source:
// Borgnakke & Larsen, J. Comput. Phys. 18 (1975) 405, eqs. 9-12; Bird, Molecular Gas Dynamics (1994), sec. 5.5.
// Deviation: they share out the whole relative energy (Beta(2, zeta) for hard spheres); only the normal part is used
// here, which leaves the tangential relative velocity alone as smooth spheres must.
//
// zeta = 2/(gamma-1) - 3, internal degrees of freedom of a particle; gamma in (1, 5/3]; zeta = 0 is an elastic sphere.
// Symbols: mu [kg], v_n [m/s], e [J]. No stability limit.
#include <cmath>

#include "coupling/base/counter_random.hpp"
#include "particle_solver/kernels/gamma_variate.hpp"

namespace standoff::particles {

/// Internal degrees of freedom of a particle in a gas with this ratio of specific heats; 0 for gamma = 5/3.
inline double internal_degrees_of_freedom(double gamma) {
  const double zeta = 2.0 / (gamma - 1.0) - 3.0, whole = std::round(zeta);
  return std::fabs(zeta - whole) < 1e-9 ? std::fmax(whole, 0.0) : zeta;  // 1.4 is not a binary number, 2 is meant
}

/// Share of the energy that is translational in equilibrium: 3 (gamma - 1) / 2.
inline double translational_share(double gamma) {
  return 3.0 / (3.0 + internal_degrees_of_freedom(gamma));
}

/// A Beta(a, a) variate, a > 0. For a >= 1/2 Ulrich's polar form [Devroye, Non-Uniform Random Variate Generation
/// (1986), ch. IX.3.3]: 1/2 + cos(2 pi V) sqrt(1 - U^(2/(2a-1))) / 2. Below, Johnk's rejection [ibid., ch. IX.3.5].
inline double symmetric_beta(double a, CounterRandom& random) {
  if (a == 1.0) return random.uniform();
  if (a > 0.5) {
    const double power = std::pow(random.uniform(), 2.0 / (2.0 * a - 1.0));
    return 0.5 + 0.5 * std::cos(6.283185307179586 * random.uniform()) * std::sqrt(1.0 - power);
  }
  for (;;) {
    // Logarithms: for small a the powers U^(1/a) underflow.
    const double x = std::log(random.uniform()) / a, y = std::log(random.uniform()) / a;
    const double larger = std::fmax(x, y), sum = std::exp(x - larger) + std::exp(y - larger);
    if (larger + std::log(sum) <= 0.0) return std::exp(x - larger) / sum;
  }
}

struct EnergyExchange {
  double normal_velocity = 0.0;           // m/s after the impact, > 0
  double energy_i = 0.0, energy_j = 0.0;  // J
};

/// One impact with exchange; v_n is the normal relative velocity before (its sign does not matter).
inline EnergyExchange larsen_borgnakke(double mu, double v_n, double e_i, double e_j, double zeta,
                                       CounterRandom& random) {
  const double total = 0.5 * mu * v_n * v_n + e_i + e_j;
  const double u = random.uniform();
  // 1 - (1-u)^(1/zeta), without cancellation for small u; zeta = 2 (gamma = 1.4) needs no transcendental function.
  const double share = zeta == 2.0 ? u / (1.0 + std::sqrt(1.0 - u)) : -std::expm1(std::log1p(-u) / zeta);
  const double normal = total * share, rest = total - normal;
  EnergyExchange result;
  result.normal_velocity = std::sqrt(2.0 * normal / mu);
  result.energy_i = rest * symmetric_beta(0.5 * zeta, random);
  result.energy_j = rest - result.energy_i;
  return result;
}

/// The same for two kinds of particles: mean exponent, and shares Beta(zeta_i / 2, zeta_j / 2) as a ratio of Gammas.
inline EnergyExchange larsen_borgnakke_unlike(double mu, double v_n, double e_i, double e_j, double zeta_i,
                                              double zeta_j, CounterRandom& random) {
  if (zeta_i == zeta_j) return larsen_borgnakke(mu, v_n, e_i, e_j, zeta_i, random);
  const double total = 0.5 * mu * v_n * v_n + e_i + e_j;
  const double normal = total * -std::expm1(std::log1p(-random.uniform()) / (0.5 * (zeta_i + zeta_j)));
  const double a = zeta_i > 0.0 ? gamma_variate(0.5 * zeta_i, random) : 0.0;
  const double b = zeta_j > 0.0 ? gamma_variate(0.5 * zeta_j, random) : 0.0;
  EnergyExchange result;
  result.normal_velocity = std::sqrt(2.0 * normal / mu);
  result.energy_i = (total - normal) * (a / (a + b));
  result.energy_j = total - normal - result.energy_i;
  return result;
}

}  // namespace standoff::particles
