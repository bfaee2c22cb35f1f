#pragma once
// Logarithm and exponential of symmetric 3x3 tensors close to the identity, without eigenvalues.
//   ln(I + X) = X - X^2/2 + X^3/3 - ...        exp(Z) - I = Z + Z^2/2! + Z^3/3! + ...
// Every power is reduced by Cayley-Hamilton, X^3 = I1 X^2 - I2 X + I3 I, so one more term costs three multiply-adds:
// with q = a X^2 + b X + c I, X q = (I1 a + b) X^2 + (c - I2 a) X + I3 a I. Valid for |X| <= series_range (Frobenius
// norm), remainder relative to X: log 0.06^11/12 = 3e-15, exp 0.06^8/9! = 5e-16. Elastic strains of metals stay below
// 0.03. Tensors outside the range, lane by lane, take the eigenvalue route (Jacobi rotations): slow, and good for any
// positive definite I + X.
#include "structure_solver/elements/tensor3.hpp"

namespace standoff::structure {

inline constexpr double series_range = 0.06;

/// f(A) for a symmetric tensor through its eigenvalues; `f` maps a double to a double.
template <class Function>
inline Sym3<double> by_eigenvalues(const Sym3<double>& s, Function f) {
  double a[3][3] = {{s.xx, s.xy, s.zx}, {s.xy, s.yy, s.yz}, {s.zx, s.yz, s.zz}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 30; ++sweep) {
    const double off = a[0][1] * a[0][1] + a[1][2] * a[1][2] + a[0][2] * a[0][2];
    if (!(off > 1e-300)) break;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0.0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = std::copysign(1.0, theta) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), sn = t * c;
        for (auto& row : a) {
          const double x = row[p], y = row[q];
          row[p] = c * x - sn * y, row[q] = sn * x + c * y;
        }
        for (int k = 0; k < 3; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - sn * y, a[q][k] = sn * x + c * y;
          const double vx = v[k][p], vy = v[k][q];
          v[k][p] = c * vx - sn * vy, v[k][q] = sn * vx + c * vy;
        }
      }
  }
  Sym3<double> r{};
  for (int k = 0; k < 3; ++k) {
    const double value = f(a[k][k]), x = v[0][k], y = v[1][k], z = v[2][k];
    r.xx += value * x * x, r.yy += value * y * y, r.zz += value * z * z;
    r.xy += value * x * y, r.yz += value * y * z, r.zx += value * z * x;
  }
  return r;
}

template <class T>
inline Sym3<double> lane(const Sym3<T>& s, int i) {
  return {lane(s.xx, i), lane(s.yy, i), lane(s.zz, i), lane(s.xy, i), lane(s.yz, i), lane(s.zx, i)};
}
template <class T>
inline void set_lane(Sym3<T>& s, int i, const Sym3<double>& value) {
  set_lane(s.xx, i, value.xx), set_lane(s.yy, i, value.yy), set_lane(s.zz, i, value.zz);
  set_lane(s.xy, i, value.xy), set_lane(s.yz, i, value.yz), set_lane(s.zx, i, value.zx);
}

/// Replaces the lanes of `result` where `outside` by f of the eigenvalues of x.
template <class T, class Function>
[[gnu::noinline]] void eigenvalue_lanes(const Sym3<T>& x, MaskOf<T> outside, Sym3<T>& result, Function f) {
  for (int i = 0; i < Lanes<T>::count; ++i)
    if (lane(outside, i)) set_lane(result, i, by_eigenvalues(lane(x, i), f));
}

/// sum_k coefficient[k-1] X^k, k = 1..N
template <int N, class T>
inline Sym3<T> power_series(const Sym3<T>& x, const Sym3<T>& x2, T i1, T i2, T i3, const double (&coefficient)[N]) {
  T a = T(0.0), b = T(0.0), c = T(coefficient[N - 1]);
#pragma GCC unroll 12
  for (int k = N - 2; k >= -1; --k) {
    const T next_a = fused(i1, a, b), next_b = fused_minus(i2, a, c);
    c = k >= 0 ? fused(i3, a, T(coefficient[k >= 0 ? k : 0])) : i3 * a;
    a = next_a, b = next_b;
  }
  return {fused(a, x2.xx, fused(b, x.xx, c)), fused(a, x2.yy, fused(b, x.yy, c)), fused(a, x2.zz, fused(b, x.zz, c)),
          fused(a, x2.xy, b * x.xy),          fused(a, x2.yz, b * x.yz),          fused(a, x2.zx, b * x.zx)};
}

/// ln(I + X)
template <class T>
inline Sym3<T> log_one_plus(const Sym3<T>& x) {
  static constexpr double terms[11] = {1.0,       -1.0 / 2.0, 1.0 / 3.0, -1.0 / 4.0,  1.0 / 5.0, -1.0 / 6.0,
                                       1.0 / 7.0, -1.0 / 8.0, 1.0 / 9.0, -1.0 / 10.0, 1.0 / 11.0};
  const Sym3<T> x2 = commuting_product(x, x);
  const T i1 = trace(x), square = trace(x2);
  Sym3<T> r = power_series(x, x2, i1, T(0.5) * fused_minus(T(1.0), square, i1 * i1), determinant(x), terms);
  const MaskOf<T> outside = square > T(series_range * series_range);
  if (any(outside)) [[unlikely]]
    eigenvalue_lanes(x, outside, r, [](double value) { return std::log1p(value); });
  return r;
}

/// exp(Z) - I
template <class T>
inline Sym3<T> exp_minus_one(const Sym3<T>& z) {
  static constexpr double terms[8] = {1.0,         1.0 / 2.0,   1.0 / 6.0,    1.0 / 24.0,
                                      1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0, 1.0 / 40320.0};
  const Sym3<T> z2 = commuting_product(z, z);
  const T i1 = trace(z), square = trace(z2);
  Sym3<T> r = power_series(z, z2, i1, T(0.5) * fused_minus(T(1.0), square, i1 * i1), determinant(z), terms);
  const MaskOf<T> outside = square > T(series_range * series_range);
  if (any(outside)) [[unlikely]]
    eigenvalue_lanes(z, outside, r, [](double value) { return std::expm1(value); });
  return r;
}

}  // namespace standoff::structure
