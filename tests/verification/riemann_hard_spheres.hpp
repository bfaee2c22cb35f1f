#pragma once
// Exact solution of a shock tube (both sides at rest, the left one denser) for a gas with p = rho T Z(f), e = T /
// (gamma
// - 1), f = covolume * rho its fill, Z of hard spheres after Carnahan & Starling: what a gas of equal spheres with a
// reservoir of internal energy is. T is k T / m [m2/s2]. Z = 1 is the textbook case [Toro, Riemann Solvers and
// Numerical Methods for Fluid Dynamics, 3rd ed. 2009, ch. 4; other equations of state as in Menikoff & Plohr, Rev. Mod.
// Phys. 61 (1989) 75, sec. III].
//   isentrope   d ln T = (gamma - 1) Z d ln rho,  c^2 = T (Z + rho dZ/drho + (gamma - 1) Z^2),  du = -c d ln rho
//   shock       e - e1 = (p + p1) (1/rho1 - 1/rho) / 2,  u^2 = (p - p1) (1/rho1 - 1/rho),  speed u rho / (rho - rho1)
#include <cmath>
#include <vector>

namespace standoff::particles::test {

struct HardSphereGas {
  double gamma = 1.4, covolume = 0.0;  // m3/kg: fill = covolume * rho
  double z(double rho) const {
    const double f = covolume * rho;
    return (1 + f + f * f - f * f * f) / ((1 - f) * (1 - f) * (1 - f));
  }
  double pressure(double rho, double t) const { return rho * t * z(rho); }
  double sound(double rho, double t) const {
    const double h = 1e-5 * rho, slope = (z(rho + h) - z(rho - h)) / (2 * h);
    return std::sqrt(t * (z(rho) + rho * slope + (gamma - 1) * z(rho) * z(rho)));
  }
};

struct GasPoint {
  double rho = 0.0, t = 0.0, u = 0.0;  // kg/m3, m2/s2, m/s
};

struct ShockTube {
  GasPoint left, right, star_left, star_right;
  double shock_speed = 0.0;
  std::vector<GasPoint> fan;  // from left to star_left
  HardSphereGas gas;

  /// State at z / time, the diaphragm at 0.
  GasPoint at(double xi) const {
    if (xi > shock_speed) return right;
    if (xi > star_left.u) return star_right;
    for (const GasPoint& point : fan)
      if (xi < point.u - gas.sound(point.rho, point.t)) return point;
    return star_left;
  }
};

/// State behind a shock that runs into `ahead` and compresses it to `rho`.
inline GasPoint behind_shock(const HardSphereGas& gas, const GasPoint& ahead, double rho) {
  const double volume = 1 / ahead.rho - 1 / rho, p1 = gas.pressure(ahead.rho, ahead.t), per = 1 / (gas.gamma - 1);
  const double t = (ahead.t * per + 0.5 * p1 * volume) / (per - 0.5 * rho * gas.z(rho) * volume);
  return {rho, t, std::sqrt(std::fmax(0.0, (gas.pressure(rho, t) - p1) * volume))};
}

/// The shocked state of `ahead` at pressure p.
inline GasPoint shocked_to(const HardSphereGas& gas, const GasPoint& ahead, double p) {
  double low = ahead.rho,
         high = ahead.rho * 0.99 * (gas.gamma + 1) / (gas.gamma - 1) / (1 + 6 * gas.covolume * ahead.rho);
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    const GasPoint point = behind_shock(gas, ahead, middle);
    (gas.pressure(point.rho, point.t) < p ? low : high) = middle;
  }
  return behind_shock(gas, ahead, low);
}

inline ShockTube solve_shock_tube(const HardSphereGas& gas, const GasPoint& left, const GasPoint& right) {
  ShockTube tube{left, right, left, right, 0.0, {left}, gas};
  const double ratio = 1e-4;  // of the density, a step down the isentrope
  GasPoint point = left;
  for (;;) {  // until the products are as fast as the shocked gas of the same pressure
    const double middle = point.rho * (1 - 0.5 * ratio),
                 t = point.t * (1 - 0.5 * ratio * (gas.gamma - 1) * gas.z(point.rho));
    point.t *= std::exp(-ratio * (gas.gamma - 1) * gas.z(middle));
    point.u += ratio * gas.sound(middle, t);
    point.rho *= std::exp(-ratio);
    tube.fan.push_back(point);
    const double p = gas.pressure(point.rho, point.t);
    if (p <= gas.pressure(right.rho, right.t)) break;
    tube.star_right = shocked_to(gas, right, p);
    if (point.u >= tube.star_right.u) break;
  }
  tube.star_left = point;
  tube.shock_speed = tube.star_right.u * tube.star_right.rho / (tube.star_right.rho - right.rho);
  return tube;
}

}  // namespace standoff::particles::test
