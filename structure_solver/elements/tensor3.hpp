#pragma once
// Second-order tensors in three dimensions for the number types of lanes.hpp. Symmetric tensors hold xx, yy, zz, xy,
// yz, zx.
#include "structure_solver/elements/lanes.hpp"

namespace standoff::structure {

template <class T>
struct Sym3 {
  T xx, yy, zz, xy, yz, zx;
};

template <class T>
struct Mat3 {
  T m[3][3];
};

template <class T>
inline T trace(const Sym3<T>& a) {
  return a.xx + a.yy + a.zz;
}

/// a : b
template <class T>
inline T contract(const Sym3<T>& a, const Sym3<T>& b) {
  const T diagonal = fused(a.xx, b.xx, fused(a.yy, b.yy, a.zz * b.zz));
  const T off = fused(a.xy, b.xy, fused(a.yz, b.yz, a.zx * b.zx));
  return fused(T(2.0), off, diagonal);
}

template <class T>
inline T determinant(const Sym3<T>& a) {
  const T c0 = fused_minus(a.yz, a.yz, a.yy * a.zz);
  const T c1 = fused_minus(a.xy, a.zz, a.yz * a.zx);
  const T c2 = fused_minus(a.yy, a.zx, a.xy * a.yz);
  return fused(a.xx, c0, fused(a.xy, c1, a.zx * c2));
}

/// a b for commuting a and b, whose product is symmetric.
template <class T>
inline Sym3<T> commuting_product(const Sym3<T>& a, const Sym3<T>& b) {
  return {fused(a.xx, b.xx, fused(a.xy, b.xy, a.zx * b.zx)), fused(a.xy, b.xy, fused(a.yy, b.yy, a.yz * b.yz)),
          fused(a.zx, b.zx, fused(a.yz, b.yz, a.zz * b.zz)), fused(a.xx, b.xy, fused(a.xy, b.yy, a.zx * b.yz)),
          fused(a.xy, b.zx, fused(a.yy, b.yz, a.yz * b.zz)), fused(a.xx, b.zx, fused(a.xy, b.yz, a.zx * b.zz))};
}

/// Cofactors: F cof(F)^T = det F.
template <class T>
inline Mat3<T> cofactor(const Mat3<T>& f) {
  Mat3<T> c;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
#pragma GCC unroll 3
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c.m[i][j] = fused_minus(f.m[i1][j2], f.m[i2][j1], f.m[i1][j1] * f.m[i2][j2]);
    }
  }
  return c;
}

template <class T>
inline Mat3<T> times(const Mat3<T>& a, const Sym3<T>& s) {
  Mat3<T> r;
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
    const T x = a.m[i][0], y = a.m[i][1], z = a.m[i][2];
    r.m[i][0] = fused(x, s.xx, fused(y, s.xy, z * s.zx));
    r.m[i][1] = fused(x, s.xy, fused(y, s.yy, z * s.yz));
    r.m[i][2] = fused(x, s.zx, fused(y, s.yz, z * s.zz));
  }
  return r;
}

/// Row i of a times row j of b: (a b^T)_ij.
template <class T>
inline T rows(const Mat3<T>& a, int i, const Mat3<T>& b, int j) {
  return fused(a.m[i][0], b.m[j][0], fused(a.m[i][1], b.m[j][1], a.m[i][2] * b.m[j][2]));
}

/// a s a^T
template <class T>
inline Sym3<T> congruence(const Mat3<T>& a, const Sym3<T>& s) {
  const Mat3<T> as = times(a, s);
  return {rows(as, 0, a, 0), rows(as, 1, a, 1), rows(as, 2, a, 2),
          rows(as, 0, a, 1), rows(as, 1, a, 2), rows(as, 2, a, 0)};
}

template <class T>
inline Mat3<T> transpose(const Mat3<T>& a) {
  return {{{a.m[0][0], a.m[1][0], a.m[2][0]}, {a.m[0][1], a.m[1][1], a.m[2][1]}, {a.m[0][2], a.m[1][2], a.m[2][2]}}};
}

}  // namespace standoff::structure
