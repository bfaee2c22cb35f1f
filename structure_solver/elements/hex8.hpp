#pragma once
// Kinematics of the 8-node hexahedron that bends: trilinear displacements, Green strains 2 E = F^T F - I whose
// components across the plate are taken where bending leaves them alone, and one enhanced strain.
//   E_xx, E_yy, E_xy   at the Gauss point, from the displacements
//   E_zx               at (0, -1, 0) and (0, 1, 0), linear in eta between
//   E_yz               at (-1, 0, 0) and (1, 0, 0), linear in xi between
//   E_zz               at the four corners of the mid-surface, bilinear between, plus alpha zeta
// The first two cure transverse shear locking (Dvorkin & Bathe, Eng. Comput. 1 (1984) 77), the corners that of curved
// thickness (Betsch & Stein, Comm. Num. Meth. Engng 11 (1995) 899), alpha the one of Poisson's effect and of plastic
// incompressibility in bending (Simo & Rifai, IJNME 29 (1990) 1595, in the Green strain: Klinkel, Gruttmann & Wagner,
// Comput. Struct. 71 (1999) 43). One alpha per element: its stress does no work, integral of S_zz zeta dV = 0.
// All three across z: the element is a piece of a plate, z its normal at rest. Bending in the plane still locks.
// The law of the metal asks for a deformation gradient: the upper triangle U with U^T U = C, a turned F. The plastic
// metric belongs to the shape at rest and does not see the turn.
//
// DATA LAYOUT  modes of a field: T[8], factor of xi^i eta^j zeta^k at i + 2 j + 4 k, like node (i, j, k) of the element
#include <array>
#include <cmath>

#include "structure_solver/elements/tensor3.hpp"

namespace standoff::structure {

struct HexPlace {
  double x, y, z;  // parametric, -1 .. 1
};

inline constexpr double hex8_gauss = 0.57735026918962576451;
inline constexpr HexPlace hex8_point(int q) {
  return {q & 1 ? hex8_gauss : -hex8_gauss, q & 2 ? hex8_gauss : -hex8_gauss, q & 4 ? hex8_gauss : -hex8_gauss};
}
// Where the strains across the plate are taken.
inline constexpr HexPlace shear_zx_place[2] = {{0, -1, 0}, {0, 1, 0}}, shear_yz_place[2] = {{-1, 0, 0}, {1, 0, 0}};
inline constexpr HexPlace thickness_place[4] = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};

/// Nodal values to modes, one butterfly along each axis.
template <class T>
inline void hex8_modes(const T (&nodal)[8], T (&modes)[8]) {
  for (int a = 0; a < 8; ++a) modes[a] = nodal[a] * T(0.125);
  for (const int stride : {1, 2, 4})
    for (int a = 0; a < 8; ++a) {
      if (a & stride) continue;
      const T low = modes[a], high = modes[a + stride];
      modes[a] = low + high, modes[a + stride] = high - low;
    }
}

/// Transpose of hex8_modes.
template <class T>
inline void hex8_modes_transpose(const T (&modes)[8], T (&nodal)[8]) {
  for (int a = 0; a < 8; ++a) nodal[a] = modes[a] * T(0.125);
  for (const int stride : {1, 2, 4})
    for (int a = 0; a < 8; ++a) {
      if (a & stride) continue;
      const T low = nodal[a], high = nodal[a + stride];
      nodal[a] = low - high, nodal[a + stride] = low + high;
    }
}

/// The four modes that vary along direction d, and what they weigh in the derivative along it.
struct SlopeOfModes {
  int mode[4];
  double weight[4];
};
inline constexpr SlopeOfModes slope_of_modes(int d, HexPlace p) {
  if (d == 0) return {{1, 3, 5, 7}, {1.0, p.y, p.z, p.y * p.z}};
  if (d == 1) return {{2, 3, 6, 7}, {1.0, p.x, p.z, p.x * p.z}};
  return {{4, 5, 6, 7}, {1.0, p.x, p.y, p.x * p.y}};
}

template <class T>
struct Column3 {
  T v[3];
};

template <class T>
inline T dot(const Column3<T>& a, const Column3<T>& b) {
  return fused(a.v[0], b.v[0], fused(a.v[1], b.v[1], a.v[2] * b.v[2]));
}

/// du / dX_d at p: `scale` is 2 / edge along d.
template <class T>
inline Column3<T> slope(const T (&modes)[3][8], int d, HexPlace p, double scale) {
  const SlopeOfModes s = slope_of_modes(d, p);
  Column3<T> column;
  for (int i = 0; i < 3; ++i) {
    T sum = modes[i][s.mode[0]];
    for (int m = 1; m < 4; ++m) sum = fused(T(s.weight[m]), modes[i][s.mode[m]], sum);
    column.v[i] = sum * T(scale);
  }
  return column;
}

/// Transpose of slope: adds `factor` * column to the forces on the modes.
template <class T>
inline void add_slope(T (&modes)[3][8], int d, HexPlace p, double scale, T factor, const Column3<T>& column) {
  const SlopeOfModes s = slope_of_modes(d, p);
  for (int i = 0; i < 3; ++i) {
    const T value = factor * column.v[i] * T(scale);
    for (int m = 0; m < 4; ++m) modes[i][s.mode[m]] = fused(T(s.weight[m]), value, modes[i][s.mode[m]]);
  }
}

/// 2 E_jk of the columns j, k of H.
template <class T>
inline T twice_green(const Column3<T>& a, int j, const Column3<T>& b, int k) {
  return a.v[k] + b.v[j] + dot(a, b);
}

/// Column j of F.
template <class T>
inline Column3<T> stretched(Column3<T> column, int j) {
  column.v[j] += T(1.0);
  return column;
}

/// Twice the strains across the plate where they are taken.
template <class T>
struct AcrossStrains {
  T zx[2], yz[2], zz[4];
};

template <class T>
inline AcrossStrains<T> across_strains(const T (&u)[3][8], const double (&scale)[3]) {
  AcrossStrains<T> s;
  for (int t = 0; t < 2; ++t) {
    const HexPlace a = shear_zx_place[t], b = shear_yz_place[t];
    s.zx[t] = twice_green(slope(u, 0, a, scale[0]), 0, slope(u, 2, a, scale[2]), 2);
    s.yz[t] = twice_green(slope(u, 1, b, scale[1]), 1, slope(u, 2, b, scale[2]), 2);
  }
  for (int t = 0; t < 4; ++t) {
    const Column3<T> z = slope(u, 2, thickness_place[t], scale[2]);
    s.zz[t] = twice_green(z, 2, z, 2);
  }
  return s;
}

/// Weights of the places in a point.
inline constexpr double linear_weight(int t, double x) {
  return 0.5 * (t == 0 ? 1.0 - x : 1.0 + x);
}
inline constexpr double corner_weight(int t, HexPlace p) {
  return linear_weight(t & 1, p.x) * linear_weight(t >> 1, p.y);
}

/// 2 E at the point p, without the enhanced strain.
template <class T>
inline Sym3<T> twice_assumed_strain(const T (&u)[3][8], const double (&scale)[3], const AcrossStrains<T>& across,
                                    HexPlace p) {
  const Column3<T> x = slope(u, 0, p, scale[0]), y = slope(u, 1, p, scale[1]);
  Sym3<T> e{twice_green(x, 0, x, 0), twice_green(y, 1, y, 1), T(0.0), twice_green(x, 0, y, 1), T(0.0), T(0.0)};
  for (int t = 0; t < 2; ++t) {
    e.zx = fused(T(linear_weight(t, p.y)), across.zx[t], e.zx);
    e.yz = fused(T(linear_weight(t, p.x)), across.yz[t], e.yz);
  }
  for (int t = 0; t < 4; ++t) e.zz = fused(T(corner_weight(t, p)), across.zz[t], e.zz);
  return e;
}

/// U - I with U^T U = I + e, U upper triangular; not a number where I + e is not positive definite. Small strains keep
/// their digits: sqrt(1 + a) - 1 = a / (1 + sqrt(1 + a)).
template <class T>
inline Mat3<T> triangular_gradient(const Sym3<T>& e) {
  const T one = T(1.0), zero = T(0.0);
  const T u0 = square_root(one + e.xx), h01 = e.xy / u0, h02 = e.zx / u0;
  const T a1 = fused_minus(h01, h01, e.yy), u1 = square_root(one + a1), h12 = fused_minus(h01, h02, e.yz) / u1;
  const T a2 = fused_minus(h12, h12, fused_minus(h02, h02, e.zz)), u2 = square_root(one + a2);
  return {{{e.xx / (one + u0), h01, h02}, {zero, a1 / (one + u1), h12}, {zero, zero, a2 / (one + u2)}}};
}

/// Second Piola-Kirchhoff stress U^-1 P, U = I + h upper triangular.
template <class T>
inline Sym3<T> pulled_back(const Mat3<T>& h, const Mat3<T>& p) {
  const T one = T(1.0);
  const T i0 = one / (one + h.m[0][0]), i1 = one / (one + h.m[1][1]), i2 = one / (one + h.m[2][2]);
  const T zz = p.m[2][2] * i2, zx = p.m[2][0] * i2, zy = p.m[2][1] * i2;
  const T yy = fused_minus(h.m[1][2], zy, p.m[1][1]) * i1, yx = fused_minus(h.m[1][2], zx, p.m[1][0]) * i1;
  const T xx = fused_minus(h.m[0][1], yx, fused_minus(h.m[0][2], zx, p.m[0][0])) * i0;
  return {xx, yy, zz, yx, zy, zx};
}

/// F = Q R by Gram-Schmidt: Q of the columns of F.
inline Mat3<double> turn_of(const Mat3<double>& f) {
  Mat3<double> q = f;
  for (int d = 0; d < 3; ++d) {
    for (int b = 0; b < d; ++b) {
      const double along = q.m[0][d] * q.m[0][b] + q.m[1][d] * q.m[1][b] + q.m[2][d] * q.m[2][b];
      for (auto& row : q.m) row[d] -= along * row[b];
    }
    const double length = std::sqrt(q.m[0][d] * q.m[0][d] + q.m[1][d] * q.m[1][d] + q.m[2][d] * q.m[2][d]);
    for (auto& row : q.m) row[d] /= length;
  }
  return q;
}

/// Q U - I at the Gauss points, with the turn Q of the displacements: what the metal feels, seen from the laboratory.
inline std::array<Mat3<double>, 8> hex8_gradients(const double (&nodal)[3][8], const double (&scale)[3], double alpha) {
  double u[3][8];
  for (int c = 0; c < 3; ++c) hex8_modes(nodal[c], u[c]);
  const AcrossStrains<double> across = across_strains(u, scale);
  std::array<Mat3<double>, 8> result;
  for (int q = 0; q < 8; ++q) {
    const HexPlace p = hex8_point(q);
    Sym3<double> e = twice_assumed_strain(u, scale, across, p);
    e.zz += 2.0 * alpha * p.z;
    const Mat3<double> h = triangular_gradient(e);
    Mat3<double> f;
    for (int d = 0; d < 3; ++d) {
      const Column3<double> column = stretched(slope(u, d, p, scale[d]), d);
      for (int i = 0; i < 3; ++i) f.m[i][d] = column.v[i];
    }
    const Mat3<double> turn = turn_of(f);
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) {
        double sum = turn.m[i][d] - (i == d ? 1.0 : 0.0);
        for (int k = 0; k <= d; ++k) sum += turn.m[i][k] * h.m[k][d];
        result[static_cast<std::size_t>(q)].m[i][d] = sum;
      }
  }
  return result;
}

}  // namespace standoff::structure
