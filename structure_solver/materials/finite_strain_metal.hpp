#pragma once
// One material point of a metal at finite strain: displacement gradient in, first Piola-Kirchhoff stress out.
//   F = I + H = Fe Fp,  be = F Cp^-1 F^T,  eps = 1/2 ln be  (Hencky)         Simo, CMAME 99 (1992) 61
//   tau = 2 G dev(eps) + K (tr eps - 3 alpha (T - Tr)) I,   P = tau F^-T      stress = gradient of a stored energy
//   yield on Cauchy stress: sqrt(3/2) |dev tau| <= J sigma_y                  flow: plastic_flow.hpp
//   be_new = exp(-2 dp n) be,  n = 3 G dev(eps) / Q;   Cp^-1 gains F^-1 (be_new - be) F^-T: isochoric
// Stress is a function of the displacement and the committed history alone: implicit solvers may ask for it anywhere.
// The history holds Cp^-1 - I, not Cp^-1, and be - I is summed from small terms, so tiny strains keep their digits.
//
// Effects are types: what is off has no field in the history and no instruction in the loop.
// Valid while elastic strains are small beside 1 (any size works, slowly: tensor_series.hpp). det F <= 0 shows in the
// result.
#include "structure_solver/elements/tensor_series.hpp"
#include "structure_solver/materials/plastic_flow.hpp"

namespace standoff::structure {

struct MetalParameters {
  double bulk = 0.0, shear = 0.0;  // K, G, Pa
  JohnsonCook flow;
  double heating = 0.0;    // chi / (rho cp), K m3/J
  double expansion = 0.0;  // 3 alpha, 1/K
};

/// What a step asks of a point.
struct PointStep {
  double dt = 0.0;   // s since the committed state; 0: no rate, no heat (static trial)
  bool flow = true;  // false: plastic flow frozen, elastic answer only
};

template <Hardening Hard, RateLaw Rate, bool HasHeating, bool HasExpansion>
struct Metal {
  static_assert(HasHeating || !HasExpansion, "without heating the temperature never changes");
  static constexpr bool plasticity = true, heating = HasHeating, expansion = HasExpansion;
  static constexpr Hardening hardening = Hard;
  static constexpr RateLaw rate = Rate;
  static constexpr bool varies = hardening != Hardening::none || heating;  // its static flow stress
  // History fields: Cp^-1 - I (6), plastic strain, then those the effects call for; -1 is absent.
  static constexpr int strain_field = 6;
  static constexpr int temperature_field = heating ? 7 : -1;
  static constexpr int static_stress_field = varies ? 7 + heating : -1;
  static constexpr int x_field = rate != RateLaw::none ? 7 + heating + varies : -1;
  static constexpr int fields = 7 + heating + varies + (rate != RateLaw::none);
};

/// Elastic in logarithmic strain at any stress: no history, no flow.
struct Elastic {
  static constexpr bool plasticity = false, heating = false, expansion = false;
  static constexpr Hardening hardening = Hardening::none;
  static constexpr RateLaw rate = RateLaw::none;
  static constexpr int strain_field = -1, temperature_field = -1, static_stress_field = -1, x_field = -1, fields = 0;
};

template <class T>
struct PointHistory {
  Sym3<T> c;  // Cp^-1 - I
  T strain, temperature, static_stress, x;
};

template <class T>
struct PointResult {
  Mat3<T> p;       // first Piola-Kirchhoff stress, Pa
  T volume_ratio;  // J
  T elastic;       // stored energy, J/m3 of reference volume
  T inelastic;     // work on plastic and thermal strain in this step, J/m3
  MaskOf<T> flowed;
};

/// be - I = H + H^T + H H^T + F (Cp^-1 - I) F^T
template <class T>
inline Sym3<T> elastic_left_cauchy_green(const Mat3<T>& h, const Mat3<T>& f, const Sym3<T>& c) {
  const Mat3<T> fc = times(f, c);
  auto part = [&](int i, int j) { return h.m[i][j] + h.m[j][i] + rows(h, i, h, j) + rows(fc, i, f, j); };
  return {part(0, 0), part(1, 1), part(2, 2), part(0, 1), part(1, 2), part(2, 0)};
}

/// The same without flow: b - I
template <class T>
inline Sym3<T> left_cauchy_green(const Mat3<T>& h) {
  auto part = [&](int i, int j) { return h.m[i][j] + h.m[j][i] + rows(h, i, h, j); };
  return {part(0, 0), part(1, 1), part(2, 2), part(0, 1), part(1, 2), part(2, 0)};
}

template <class T>
inline Mat3<T> deformation_gradient(const Mat3<T>& h) {
  Mat3<T> f = h;
  for (int i = 0; i < 3; ++i) f.m[i][i] += T(1.0);
  return f;
}

/// Flow of the lanes in `active`: the law of the step, or the rate-independent law of a static trial.
template <class Law, class T>
inline FlowResult<T> flow_of_step(const MetalParameters& metal, const PointHistory<T>& s, T trial, T volume_ratio,
                                  double dt, MaskOf<T> active) {
  const bool moving = dt > 0.0;
  FlowProblem<T> f{trial, volume_ratio, s.strain, s.temperature, 3.0 * metal.shear, 0.0, 0.0};
  if (moving) f.heating = metal.heating;
  const T upper = (trial - volume_ratio * s.static_stress) * T(1.0 / f.triple_shear);
  if constexpr (Law::rate != RateLaw::none) {
    if (moving) {
      f.rate_strain = metal.flow.reference_rate * dt;
      return solve_flow<Law::hardening, Law::heating, Law::rate>(metal.flow, f, active, s.x);
    }
  }
  FlowResult<T> r = solve_flow<Law::hardening, Law::heating, RateLaw::none>(metal.flow, f, active, upper);
  r.x = s.x;
  return r;
}

/// Cp^-1 gains F^-1 be (exp(-shrink dev) - I) F^-T
template <class T>
inline void advance_plastic_metric(const Mat3<T>& inverse, const Sym3<T>& x, const Sym3<T>& dev, T shrink,
                                   MaskOf<T> flowed, Sym3<T>& c) {
  const Sym3<T> z{-shrink * dev.xx, -shrink * dev.yy, -shrink * dev.zz,
                  -shrink * dev.xy, -shrink * dev.yz, -shrink * dev.zx};
  const Sym3<T> e = exp_minus_one(z);
  const Sym3<T> xe = commuting_product(x, e);
  const Sym3<T> change{e.xx + xe.xx, e.yy + xe.yy, e.zz + xe.zz, e.xy + xe.xy, e.yz + xe.yz, e.zx + xe.zx};
  const Sym3<T> gain = congruence(inverse, change);
  const T zero = T(0.0);
  c.xx += select(flowed, gain.xx, zero), c.yy += select(flowed, gain.yy, zero), c.zz += select(flowed, gain.zz, zero);
  c.xy += select(flowed, gain.xy, zero), c.yz += select(flowed, gain.yz, zero), c.zx += select(flowed, gain.zx, zero);
}

/// Yield and flow of the lanes whose trial stress is too high; returns what is left of the stress deviator.
template <class Law, class T>
inline T flow_point(const MetalParameters& metal, const PointStep& step, T trial, const Mat3<T>& inverse_transposed,
                    const Sym3<T>& x, const Sym3<T>& dev, PointHistory<T>& s, PointResult<T>& out) {
  const T limit = fused(out.volume_ratio, s.static_stress, T(yield_tolerance * metal.flow.A));
  const MaskOf<T> yielding = (trial > limit) & (out.volume_ratio > T(0.0));  // a point inside out keeps its history
  if (!step.flow || !any(yielding)) return T(1.0);
  const FlowResult<T> flow = flow_of_step<Law>(metal, s, trial, out.volume_ratio, step.dt, yielding);
  const T increment = select(yielding, flow.increment, T(0.0));
  const T drop = select(yielding, T(3.0 * metal.shear) * increment / trial, T(0.0));
  const T scale = T(1.0) - drop;
  advance_plastic_metric(transpose(inverse_transposed), x, dev, drop + drop, yielding, s.c);
  s.strain += increment;
  s.temperature = select(yielding, flow.temperature, s.temperature);
  s.static_stress = select(yielding, flow.static_stress, s.static_stress);
  s.x = select(yielding, flow.x, s.x);
  out.inelastic = select(yielding, trial * scale * increment, T(0.0));
  out.flowed = yielding;
  return scale;
}

/// Stress at H from the committed history `s`, which becomes the trial history.
template <class Law, class T>
inline PointResult<T> update_point(const MetalParameters& metal, const Mat3<T>& h, const PointStep& step,
                                   PointHistory<T>& s) {
  PointResult<T> out;
  const Mat3<T> f = deformation_gradient(h);
  Mat3<T> inverse_transposed = cofactor(f);
  out.volume_ratio = rows(f, 0, inverse_transposed, 0);
  const T inverse_j = T(1.0) / out.volume_ratio;
  for (auto& row : inverse_transposed.m)
    for (T& entry : row) entry *= inverse_j;

  Sym3<T> x;
  if constexpr (Law::plasticity)
    x = elastic_left_cauchy_green(h, f, s.c);
  else
    x = left_cauchy_green(h);
  Sym3<T> dev = log_one_plus(x);  // 2 eps, then its deviator over 2
  const T twice_volumetric = trace(dev);
  const T half = T(0.5), mean = twice_volumetric * T(1.0 / 3.0);
  dev = {half * (dev.xx - mean), half * (dev.yy - mean), half * (dev.zz - mean),
         half * dev.xy,          half * dev.yz,          half * dev.zx};
  const T square = contract(dev, dev);
  T scale = T(1.0);
  out.inelastic = T(0.0);
  out.flowed = Lanes<T>::all_false();
  [[maybe_unused]] const T old_temperature = s.temperature;
  if constexpr (Law::plasticity)
    scale =
        flow_point<Law>(metal, step, T(metal.shear) * square_root(T(6.0) * square), inverse_transposed, x, dev, s, out);

  T volumetric = half * twice_volumetric;
  if constexpr (Law::expansion)
    volumetric = fused_minus(T(metal.expansion), s.temperature - T(metal.flow.room_temperature), volumetric);
  const T pressure = T(metal.bulk) * volumetric;
  if constexpr (Law::expansion)
    out.inelastic = fused(pressure * T(metal.expansion), s.temperature - old_temperature, out.inelastic);
  out.elastic = fused(half * pressure, volumetric, T(metal.shear) * scale * scale * square);
  const T g2 = T(2.0 * metal.shear) * scale;
  const Sym3<T> tau{fused(g2, dev.xx, pressure),
                    fused(g2, dev.yy, pressure),
                    fused(g2, dev.zz, pressure),
                    g2 * dev.xy,
                    g2 * dev.yz,
                    g2 * dev.zx};
  // P = tau F^-T: rows of tau (symmetric) times columns of F^-T.
  out.p = transpose(times(transpose(inverse_transposed), tau));
  return out;
}

}  // namespace standoff::structure
