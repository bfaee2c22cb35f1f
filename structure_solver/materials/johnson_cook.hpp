#pragma once
// Flow stress of metals at high rate and temperature.
//   sigma_y(p, dp/dt, T) = (A + B p^n) R(dp/dt) (1 - T*^m),   T* = (T - Tr) / (Tm - Tr) held in [0, 1]
//   or a table in place of A + B p^n: straight lines between measured points, level after the last
//   R = (1 + rate/rate0)^C   modified law, smooth at rest [Borvik 2011, sec. 3.4]; Borvik, Hopperstad, Berstad,
//   Langseth,
//                            Eur. J. Mech. A/Solids 20 (2001) 685
//   R = 1 + C ln max(1, rate/rate0)   original law: Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31
// The rate enters as x = ln(1 + rate/rate0): the power law is e^(C x), nearly linear over ten decades of rate.
//
// Symbols: p plastic strain (-, >= 0), T temperature (K), A B (Pa), n C m (-), rate0 (1/s).
// Deviations: never below softest_fraction * A, so that molten metal keeps a yield surface; p and T* are held above
// 1e-12, where the slopes of p^n (n < 1) and T*^m (m < 1) have no value.
#include <array>
#include <span>

#include "structure_solver/elements/lane_math.hpp"

namespace standoff::structure {

inline constexpr int largest_table = 32;  // points

/// A curve of straight lines as a sum of bends: sigma(p) = A + sum_k bend_k max(0, p - strain_k), without a branch.
struct HardeningTable {
  int bends = 0;
  std::array<double, largest_table> strain{}, bend{};  // -, Pa: what the slope gains there
};

/// From points of rising plastic strain, the first at 0, and their flow stress [Pa].
inline HardeningTable hardening_table(std::span<const double> strain, std::span<const double> stress) {
  HardeningTable table;
  double slope = 0.0;
  for (std::size_t k = 0; k < strain.size() && k < largest_table; ++k) {
    const bool last = k + 1 == strain.size();
    const double next = last ? 0.0 : (stress[k + 1] - stress[k]) / (strain[k + 1] - strain[k]);
    table.strain[k] = strain[k], table.bend[k] = next - slope;
    slope = next, ++table.bends;
  }
  return table;
}

enum class Hardening { none, power, table };

struct JohnsonCook {
  double A = 0.0, B = 0.0, n = 1.0;
  double C = 0.0, reference_rate = 1.0;
  double m = 1.0, room_temperature = 293.0, melting_temperature = 1e4;
  HardeningTable table{};
};

enum class RateLaw { none, power, logarithmic };

inline constexpr double softest_fraction = 1e-6;
inline constexpr double smallest_argument = 1e-12;

/// Static flow stress (A + B p^n)(1 - T*^m) and its slopes.
template <class T>
struct StaticFlow {
  T stress, by_strain, by_temperature;
};

template <Hardening Hard, bool Softening, class T>
inline StaticFlow<T> static_flow(const JohnsonCook& law, T p, T temperature) {
  StaticFlow<T> flow{T(law.A), T(0.0), T(0.0)};
  if constexpr (Hard == Hardening::table) {
    for (int k = 0; k < law.table.bends; ++k) {
      const T beyond = p - T(law.table.strain[static_cast<std::size_t>(k)]),
              bend(law.table.bend[static_cast<std::size_t>(k)]);
      flow.stress = fused(bend, larger(beyond, T(0.0)), flow.stress);
      flow.by_strain += select(T(0.0) > beyond, T(0.0), bend);
    }
  }
  if constexpr (Hard == Hardening::power) {
    const T strain = larger(p, T(smallest_argument));
    const T power = raise(strain, law.n);
    flow.stress = fused(T(law.B), power, T(law.A));
    flow.by_strain = T(law.B * law.n) * power / strain;
  }
  if constexpr (Softening) {
    const double range = 1.0 / (law.melting_temperature - law.room_temperature);
    const T homologous = (temperature - T(law.room_temperature)) * T(range);
    const T held = smaller(larger(homologous, T(smallest_argument)), T(1.0));
    const T power = select(homologous > T(smallest_argument), raise(held, law.m), T(0.0));
    const T softening = T(1.0) - power;
    flow.by_temperature = -flow.stress * T(law.m * range) * power / held;
    flow.stress *= softening, flow.by_strain *= softening;
    const MaskOf<T> molten = flow.stress < T(softest_fraction * law.A);
    flow.stress = select(molten, T(softest_fraction * law.A), flow.stress);
    flow.by_strain = select(molten, T(0.0), flow.by_strain);
    flow.by_temperature = select(molten, T(0.0), flow.by_temperature);
  }
  return flow;
}

/// Rate factor and its slope by x = ln(1 + rate/rate0), at e^x.
template <class T>
struct RateFactor {
  T factor, by_x;
};

template <RateLaw Law, class T>
inline RateFactor<T> rate_factor(const JohnsonCook& law, T x, T exp_x) {
  if constexpr (Law == RateLaw::power) {
    const T factor = exponential(T(law.C) * x);
    return {factor, T(law.C) * factor};
  } else {
    const T ratio = exp_x - T(1.0);  // rate / rate0
    const MaskOf<T> fast = ratio > T(1.0);
    const T held = larger(ratio, T(1.0));
    return {fused(T(law.C), logarithm(held), T(1.0)), select(fast, T(law.C) * exp_x / held, T(0.0))};
  }
}

}  // namespace standoff::structure
