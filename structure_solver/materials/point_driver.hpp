#pragma once
// A stand-alone driver of one material point: uniaxial, isochoric stretch at a held plastic strain rate, the test that
// flow curves are measured by. Stress is the Mises stress of the Cauchy stress: axial minus lateral.
//
// Each step asks for a plastic strain gained of rate * dt, to 1e-8 of it: the stretch that gives it is found within a
// bracket. The point sees nothing but displacement gradients, as in an element.
#include <algorithm>
#include <cmath>
#include <vector>

#include "structure_solver/materials/finite_strain_metal.hpp"

namespace standoff::structure {

struct PointPath {
  double rate = 1.0;         // 1/s, plastic; without meaning for a law without rate
  double until = 0.5;        // plastic strain at the end
  int steps = 1000;          // equal steps of plastic strain
  double temperature = 0.0;  // K, at the start; 0: room temperature of the law
  bool isothermal = false;   // heat is taken away: the temperature stays
};

struct PointState {
  double plastic_strain = 0.0;
  double stress = 0.0;       // Pa, Mises, Cauchy
  double temperature = 0.0;  // K
  double work = 0.0;         // J/m3, plastic
};

/// Mises stress at the logarithmic stretch e, and the history after it.
template <class Law>
PointState stretched_point(const MetalParameters& metal, double e, double dt, PointHistory<double>& s) {
  const double a = std::expm1(e), b = std::expm1(-0.5 * e);
  const PointResult<double> r =
      update_point<Law>(metal, Mat3<double>{{{a, 0, 0}, {0, b, 0}, {0, 0, b}}}, {dt, true}, s);
  return {s.strain, r.p.m[0][0] * (1.0 + a) - r.p.m[1][1] * (1.0 + b), s.temperature, r.inelastic};
}

/// Log stretch at which the plastic strain is `target`, between `low` where it is less and anywhere above: regula falsi
/// with halved ends (Illinois), because plastic strain is a convex function of stretch when rate counts.
template <class Law>
double stretch_for(const MetalParameters& metal, double target, double low, double step, double dt,
                   const PointHistory<double>& from) {
  const auto excess = [&](double e) {
    PointHistory<double> s = from;
    return stretched_point<Law>(metal, e, dt, s).plastic_strain - target;
  };
  double at_low = from.strain - target, high = low + step, at_high = excess(high);
  for (double width = step; at_high < 0.0; width *= 2.0)
    low = high, at_low = at_high, high += width, at_high = excess(high);
  double side = 0.0, at = high;
  for (int round = 0; round < 200; ++round) {
    at = (low * at_high - high * at_low) / (at_high - at_low);
    const double now = excess(at);
    if (std::fabs(now) <= 1e-8 * step) break;  // C times that, of the stress
    if (now < 0.0) {
      low = at, at_low = now;
      if (side < 0.0) at_high *= 0.5;
    } else {
      high = at, at_high = now;
      if (side > 0.0) at_low *= 0.5;
    }
    side = now;
  }
  return at;
}

/// One state a step. Law must yield; expansion does no plastic work and is left out (Metal<..., false>).
template <class Law>
std::vector<PointState> trace_point(MetalParameters metal, const PointPath& path) {
  static_assert(Law::plasticity && !Law::expansion);
  if (path.isothermal) metal.heating = 0.0;
  const double step = path.until / path.steps;
  const double dt = Law::rate == RateLaw::none && !Law::heating ? 0.0 : step / path.rate;
  PointHistory<double> s{};
  s.temperature = path.temperature > 0.0 ? path.temperature : metal.flow.room_temperature;
  s.static_stress = static_flow<Law::hardening, Law::heating>(metal.flow, 0.0, s.temperature).stress;
  double stretch = 0.0, work = 0.0;
  std::vector<PointState> states;
  for (int i = 1; i <= path.steps; ++i) {
    const double softening = 0.01 * step;  // stress may have fallen, and the elastic stretch with it
    stretch = stretch_for<Law>(metal, step * i, std::max(0.0, stretch - softening), step, dt, s);
    PointState now = stretched_point<Law>(metal, stretch, dt, s);
    work += now.work;
    now.work = work;
    states.push_back(now);
  }
  return states;
}

}  // namespace standoff::structure
