#pragma once
// Exponential and logarithm for the number types of lanes.hpp, a few units in the last place, the same bits on every
// machine with fused multiply-add.
//   exp x = 2^k exp r, k = round(x / ln 2), |r| <= ln 2 / 2; Taylor polynomial of degree 13: remainder 4e-18
//   log x = k ln 2 + 2 atanh s, x = 2^k m, sqrt(1/2) <= m < sqrt 2, s = (m - 1) / (m + 1), |s| <= 0.172; series to
//   s^21: 3e-18
// Range: exp clamps its argument to +-700; log needs a normal, positive number.
#include "structure_solver/elements/lanes.hpp"

namespace standoff::structure {

namespace lane_math {
inline constexpr double ln2_high = 0x1.62e42fee00000p-1;  // 32 leading bits: k * ln2_high is exact
inline constexpr double ln2_low = 0x1.a39ef35793c76p-33;
inline constexpr double round_magic = 0x1.8p52;  // adding it leaves the rounded integer in the low bits
}  // namespace lane_math

template <class T>
inline T exponential(T x) {
  using Bits = typename Lanes<T>::Bits;
  x = smaller(larger(x, T(-700.0)), T(700.0));
  const T shifted = fused(x, T(1.4426950408889634), T(lane_math::round_magic));
  const T k = shifted - T(lane_math::round_magic);
  const T r = fused_minus(k, T(lane_math::ln2_low), fused_minus(k, T(lane_math::ln2_high), x));
  const T r2 = r * r;
  // Even and odd halves shorten the chain of dependent operations.
  T even = T(1.0 / 479001600.0), odd = T(1.0 / 6227020800.0);
  constexpr double even_terms[] = {1.0 / 3628800.0, 1.0 / 40320.0, 1.0 / 720.0, 1.0 / 24.0, 0.5};
  constexpr double odd_terms[] = {1.0 / 39916800.0, 1.0 / 362880.0, 1.0 / 5040.0, 1.0 / 120.0, 1.0 / 6.0};
#pragma GCC unroll 5
  for (int i = 0; i < 5; ++i) {
    even = fused(even, r2, T(even_terms[i]));
    odd = fused(odd, r2, T(odd_terms[i]));
  }
  const T polynomial = fused(r2, fused(odd, r, even), r) + T(1.0);
  return std::bit_cast<T>(std::bit_cast<Bits>(polynomial) + (std::bit_cast<Bits>(shifted) << 52));
}

template <class T>
inline T logarithm(T x) {
  using Bits = typename Lanes<T>::Bits;
  constexpr std::uint64_t sqrt_half = 0x3FE6A09E667F3BCDull, bias = 1024;
  const Bits bits = std::bit_cast<Bits>(x);
  const Bits exponent = (bits - sqrt_half + (bias << 52)) >> 52;  // k + bias
  const T m = std::bit_cast<T>(bits - ((exponent - bias) << 52));
  const T k = std::bit_cast<T>(exponent + std::bit_cast<std::uint64_t>(lane_math::round_magic)) -
              T(lane_math::round_magic + 1024.0);
  const T f = m - T(1.0);
  const T s = f / (f + T(2.0));
  const T z = s * s, z2 = z * z;
  T even = T(1.0 / 21.0), odd = T(1.0 / 19.0);
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    even = fused(even, z2, T(1.0 / (17.0 - 4.0 * i)));
    odd = fused(odd, z2, T(1.0 / (15.0 - 4.0 * i)));
  }
  const T series = fused(z * z, even, z * odd);  // z^2/5 + z^4/9 + ... and z/3 + z^3/7 + ...
  const T twice = s + s;
  return fused(k, T(lane_math::ln2_high), twice + fused(twice, series, k * T(lane_math::ln2_low)));
}

/// base^power for base > 0.
template <class T>
inline T raise(T base, double power) {
  return exponential(T(power) * logarithm(base));
}

}  // namespace standoff::structure
