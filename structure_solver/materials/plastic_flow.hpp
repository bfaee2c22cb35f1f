#pragma once
// Radial return with rate and temperature solved together: how far a point flows in one step.
// Unknown dp >= 0, the plastic strain gained in dt, from
//   g(dp) = Q - 3 G dp - J (A + B (p + dp)^n) R(dp/dt) (1 - T*^m) = 0,   T(dp) = T_n + beta (Q - 3 G dp) dp
// Q trial Mises stress, as Kirchhoff stress (J times Cauchy): yield is on Cauchy stress. beta = chi / (rho0 cp) turns
// the plastic work Q_new dp, per reference volume, into heat. Johnson-Cook terms: johnson_cook.hpp.
//
// With rate the unknown is x = ln(1 + dp / (rate0 dt)): the rate term is brutally stiff in dp (slope C sigma / (rate0
// dt)) and nearly linear in x; lagging the rate instead makes it chatter. g falls from g(0) > 0 to g(Q/3G) <= 0: one
// root, kept in a bracket; a Newton step that leaves the bracket becomes a bisection. Converged when |g| <=
// yield_tolerance A, the tolerance of the yield test as well, so a committed state evaluated again does not flow. Lanes
// stop one by one and keep their bits.
#include "structure_solver/materials/johnson_cook.hpp"

namespace standoff::structure {

inline constexpr double yield_tolerance = 1e-10;  // of A
inline constexpr int flow_iterations = 200;       // bisection alone needs about 60

template <class T>
struct FlowProblem {
  T trial;              // Q, Pa
  T volume_ratio;       // J
  T strain;             // p
  T temperature;        // T_n, K
  double triple_shear;  // 3 G, Pa
  double heating;       // beta, K m3/J; 0: no heating
  double rate_strain;   // rate0 dt; 0: rate-independent
};

template <class T>
struct FlowResult {
  T increment;      // dp
  T temperature;    // K
  T static_stress;  // flow stress without rate at the new state, Pa
  T x;              // ln(1 + rate/rate0)
};

/// Value and slope of g at the unknown (x with WithRate, dp without), and the state there.
template <bool Hardening, bool Softening, RateLaw Rate, class T>
inline FlowResult<T> flow_residual(const JohnsonCook& law, const FlowProblem<T>& f, T unknown, T& g, T& slope) {
  T dp = unknown, dp_slope = T(1.0), factor = T(1.0), factor_slope = T(0.0);
  if constexpr (Rate != RateLaw::none) {
    const T exp_x = exponential(unknown);
    dp_slope = T(f.rate_strain) * exp_x;
    dp = fused(T(f.rate_strain), exp_x, T(-f.rate_strain));
    const RateFactor<T> rate = rate_factor<Rate>(law, unknown, exp_x);
    factor = rate.factor, factor_slope = rate.by_x;
  }
  const T stress = fused_minus(T(f.triple_shear), dp, f.trial);
  T temperature = f.temperature, heat_slope = T(0.0);
  if constexpr (Softening) {
    temperature = fused(T(f.heating) * stress, dp, f.temperature);
    heat_slope = T(f.heating) * fused_minus(T(f.triple_shear), dp, stress);
  }
  const StaticFlow<T> flow = static_flow<Hardening, Softening>(law, f.strain + dp, temperature);
  T static_slope = flow.by_strain;
  if constexpr (Softening) static_slope = fused(flow.by_temperature, heat_slope, static_slope);
  const T by_unknown = fused(flow.stress, factor_slope, factor * static_slope * dp_slope);
  g = fused_minus(f.volume_ratio * flow.stress, factor, stress);
  slope = -fused(T(f.triple_shear), dp_slope, f.volume_ratio * by_unknown);
  return {dp, temperature, flow.stress, unknown};
}

/// Solves for the lanes in `active`; `guess` is the unknown of the last flow of the point.
template <bool Hardening, bool Softening, RateLaw Rate, class T>
inline FlowResult<T> solve_flow(const JohnsonCook& law, const FlowProblem<T>& f, MaskOf<T> active, T guess) {
  T low = T(0.0), high = f.trial * T(1.0 / f.triple_shear);
  if constexpr (Rate != RateLaw::none) high = logarithm(fused(high, T(1.0 / f.rate_strain), T(1.0)));
  T unknown = smaller(guess, high);
  const T tolerance = T(yield_tolerance * law.A);
  FlowResult<T> result{T(0.0), f.temperature, T(law.A), guess};
  for (int i = 0; i < flow_iterations && any(active); ++i) {
    T g, slope;
    const FlowResult<T> now = flow_residual<Hardening, Softening, Rate>(law, f, unknown, g, slope);
    const MaskOf<T> done = active & (larger(g, -g) <= tolerance);
    result.increment = select(active, now.increment, result.increment);
    result.temperature = select(active, now.temperature, result.temperature);
    result.static_stress = select(active, now.static_stress, result.static_stress);
    result.x = select(active, now.x, result.x);
    active = active & invert(done);
    const MaskOf<T> left = g > T(0.0);
    low = select(left, unknown, low), high = select(left, high, unknown);
    const T newton = unknown - g / slope;
    const MaskOf<T> inside = (newton > low) & (newton < high);
    unknown = select(inside, newton, T(0.5) * (low + high));
  }
  result.increment = larger(result.increment, T(0.0));
  return result;
}

}  // namespace standoff::structure
