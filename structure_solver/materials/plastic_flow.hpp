#pragma once
// Radial return with rate and temperature solved together: how far a point flows in one step.
// Unknown dp >= 0, the plastic strain gained in dt, from
//   g(dp) = Q - 3 G dp - J (A + B (p + dp)^n) R(dp/dt) (1 - T*^m) = 0,   T(dp) = T_n + beta (Q - 3 G dp) dp
// Q trial Mises stress, as Kirchhoff stress (J times Cauchy): yield is on Cauchy stress. beta = chi / (rho0 cp) turns
// the plastic work Q_new dp, per reference volume, into heat. Johnson-Cook terms: johnson_cook.hpp.
//
// With rate the unknown is x = ln(1 + dp / (rate0 dt)): the rate term is brutally stiff in dp (slope C sigma / (rate0
// dt)) and nearly linear in x; lagging the rate instead makes it chatter. g falls from g(0) > 0 to g(Q/3G) <= 0: one
// root, kept in a bracket; Halley steps (the curvature is known but for the bend of the static flow stress), and a step
// that leaves the bracket becomes a bisection. Converged when |g| <= yield_tolerance A, the tolerance of the yield test
// as well, so a committed state evaluated again does not flow. In x the error after a step dx is below |g dx|
// (curvature over slope is about 1), so a last step with |g dx| <= tolerance / 4 is taken without evaluating g once
// more. Lanes stop one by one and keep their bits.
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

/// g and its derivatives by the unknown (x with rate, dp without), and the state there.
template <class T>
struct FlowResidual {
  T g, slope, curvature;
  T increment, increment_slope;   // dp
  T static_stress, static_slope;  // by dp
};

template <class T>
inline T temperature_after(const FlowProblem<T>& f, T dp) {
  return fused(T(f.heating) * fused_minus(T(f.triple_shear), dp, f.trial), dp, f.temperature);
}

template <Hardening Hard, bool Softening, RateLaw Rate, class T>
inline FlowResidual<T> flow_residual(const JohnsonCook& law, const FlowProblem<T>& f, T unknown) {
  FlowResidual<T> r{T(0.0), T(0.0), T(0.0), unknown, T(1.0), T(0.0), T(0.0)};
  RateFactor<T> rate{T(1.0), T(0.0)};
  if constexpr (Rate != RateLaw::none) {
    const T exp_x = exponential(unknown);
    r.increment_slope = T(f.rate_strain) * exp_x;
    r.increment = fused(T(f.rate_strain), exp_x, T(-f.rate_strain));
    rate = rate_factor<Rate>(law, unknown, exp_x);
  }
  const T stress = fused_minus(T(f.triple_shear), r.increment, f.trial);
  const StaticFlow<T> flow =
      static_flow<Hard, Softening>(law, f.strain + r.increment, temperature_after(f, r.increment));
  r.static_stress = flow.stress, r.static_slope = flow.by_strain;
  if constexpr (Softening) {
    const T heat_slope = T(f.heating) * fused_minus(T(f.triple_shear), r.increment, stress);
    r.static_slope = fused(flow.by_temperature, heat_slope, r.static_slope);
  }
  const T by_increment = rate.factor * r.static_slope * r.increment_slope;
  r.g = fused_minus(f.volume_ratio * flow.stress, rate.factor, stress);
  r.slope = -fused(T(f.triple_shear), r.increment_slope, f.volume_ratio * fused(flow.stress, rate.by_x, by_increment));
  if constexpr (Rate == RateLaw::power)
    r.curvature = -fused(T(f.triple_shear), r.increment_slope,
                         f.volume_ratio * fused(T(law.C) * flow.stress, rate.by_x, by_increment));
  return r;
}

/// Solves for the lanes in `active`; `guess` is the unknown of the last flow of the point.
template <Hardening Hard, bool Softening, RateLaw Rate, class T>
inline FlowResult<T> solve_flow(const JohnsonCook& law, const FlowProblem<T>& f, MaskOf<T> active, T guess) {
  T low = T(0.0), high = f.trial * T(1.0 / f.triple_shear);
  if constexpr (Rate != RateLaw::none) high = logarithm(fused(high, T(1.0 / f.rate_strain), T(1.0)));
  T unknown = smaller(guess, high);
  const T tolerance = T(yield_tolerance * law.A);
  FlowResult<T> result{T(0.0), f.temperature, T(law.A), guess};
  for (int i = 0; i < flow_iterations && any(active); ++i) {
    const FlowResidual<T> r = flow_residual<Hard, Softening, Rate>(law, f, unknown);
    const MaskOf<T> left = r.g > T(0.0);
    low = select(left, unknown, low), high = select(left, high, unknown);
    const T newton = -r.g / r.slope;
    const T halley = newton / larger(fused(T(0.5) * newton, r.curvature / r.slope, T(1.0)), T(0.5));
    const T next = unknown + halley;
    const MaskOf<T> inside = (next > low) & (next < high);

    const MaskOf<T> exact = larger(r.g, -r.g) <= tolerance;
    const T error = r.g * halley;
    MaskOf<T> last = Lanes<T>::all_false();
    if constexpr (Rate == RateLaw::power && Hard != Hardening::table)  // a table bends in corners: no such estimate
      last = inside & invert(exact) & (larger(error, -error) <= T(0.25) * tolerance);
    const T change = select(last, r.increment_slope * halley * fused(T(0.5), halley, T(1.0)), T(0.0));
    result.increment = select(active, r.increment + change, result.increment);
    result.static_stress = select(active, fused(r.static_slope, change, r.static_stress), result.static_stress);
    result.x = select(active, select(last, next, unknown), result.x);
    active = active & invert(exact | last);
    unknown = select(inside, next, T(0.5) * (low + high));
  }
  result.increment = larger(result.increment, T(0.0));
  if constexpr (Softening) result.temperature = temperature_after(f, result.increment);
  return result;
}

}  // namespace standoff::structure
