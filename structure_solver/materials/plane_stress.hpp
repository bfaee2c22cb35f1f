#pragma once
// A material point of a shell: strain in and across the lamina in, stress out, no stress normal to the lamina.
//   given  C_ab (in the lamina), C_a3 (transverse shear);   unknown  C_33   such that   S_33 = 0
// The metal is isotropic and its history (Cp^-1) lives at rest, so any F with F^T F = C gives the same S. The upper
// triangular one is taken (Cholesky factor of C): its f_33 is the thickness stretch, S = F^-1 P is a back substitution
// and S_33 = P_33 / f_33, so the condition is P_33(f_33) = 0. Rotations have dropped out: rigid motion leaves no bit.
//
// f_33 is found by secants from the committed stretch. The slope of P_33 lies between K (metal flows) and K + 4/3 G
// (elastic); it is held within half and twice these, so every step shrinks the error. Converged when
//   |P_33| <= stress_tolerance (K + 4/3 G),   a strain of 1e-11.
// Symbols: strain 2 E = C - I (-), S second Piola-Kirchhoff stress (Pa), stretch f_33 - 1 (-). Valid for det C > 0.
#include "structure_solver/materials/finite_strain_metal.hpp"

namespace standoff::structure {

inline constexpr double stress_tolerance = 1e-11;
inline constexpr int stress_iterations = 60;

/// Components in the lamina and across it: C - I, or S.
template <class T>
struct Lamina {
  T xx, yy, xy, yz, zx;
};

template <class T>
struct PlaneStress {
  Lamina<T> s;           // Pa
  T stretch;             // thickness now over thickness at rest, less one
  PointResult<T> point;  // of the last iteration
  Mat3<T> h;             // F - I, triangular
  MaskOf<T> converged;
};

/// F - I, upper triangular, from C - I; the thickness stretch is still to come.
template <class T>
inline Mat3<T> triangular_gradient(const Lamina<T>& c) {
  const T one(1.0), zero(0.0);
  const T h11 = c.xx / (one + square_root(one + c.xx)), f11 = one + h11;
  const T f12 = c.xy / f11, f13 = c.zx / f11;
  const T square = fused_minus(f12, f12, c.yy);
  const T h22 = square / (one + square_root(one + square));
  const T f23 = fused_minus(f12, f13, c.yz) / (one + h22);
  return {{{h11, f12, f13}, {zero, h22, f23}, {zero, zero, zero}}};
}

/// S = F^-1 P for triangular F and P_33 = 0.
template <class T>
inline Lamina<T> second_piola_kirchhoff(const Mat3<T>& h, const Mat3<T>& p) {
  const T f11 = T(1.0) + h.m[0][0], f22 = T(1.0) + h.m[1][1], f33 = T(1.0) + h.m[2][2];
  Lamina<T> s;
  s.zx = p.m[2][0] / f33, s.yz = p.m[2][1] / f33;
  s.yy = fused_minus(h.m[1][2], s.yz, p.m[1][1]) / f22;
  s.xy = fused_minus(h.m[1][2], s.zx, p.m[1][0]) / f22;
  s.xx = fused_minus(h.m[0][1], s.xy, fused_minus(h.m[0][2], s.zx, p.m[0][0])) / f11;
  return s;
}

/// Stress of a lamina from the committed history `s`, which becomes the trial history, and its committed stretch.
template <class Law, class T>
inline PlaneStress<T> update_lamina(const MetalParameters& metal, const Lamina<T>& c, const PointStep& step, T stretch,
                                    PointHistory<T>& s) {
  const double elastic_slope = metal.bulk + 4.0 / 3.0 * metal.shear;
  const T tolerance(stress_tolerance * elastic_slope), softest(0.5 * metal.bulk), stiffest(2.0 * elastic_slope);
  const PointHistory<T> committed = s;
  PlaneStress<T> out;
  out.h = triangular_gradient(c);
  out.stretch = stretch;
  T slope(elastic_slope), before(0.0), change(0.0);
  for (int i = 0; i < stress_iterations; ++i) {
    s = committed;
    out.h.m[2][2] = out.stretch;
    out.point = update_point<Law>(metal, out.h, step, s);
    const T normal = out.point.p.m[2][2];
    out.converged = larger(normal, -normal) <= tolerance;
    if (!any(invert(out.converged))) break;
    if (i > 0) {
      const T secant = (normal - before) / change;
      slope = select(secant > T(0.0), larger(smaller(secant, stiffest), softest), slope);  // also if 0 / 0
    }
    before = normal;
    change = select(out.converged, T(0.0), -normal / slope);
    change = larger(change, T(-0.5) * (T(1.0) + out.stretch));  // never through zero thickness
    out.stretch += change;
  }
  out.s = second_piola_kirchhoff(out.h, out.point.p);
  return out;
}

/// Von Mises equivalent of the Cauchy stress tau / J, tau = P F^T.
template <class T>
inline T von_mises(const PlaneStress<T>& lamina) {
  const Mat3<T> f = deformation_gradient(lamina.h);
  const auto tau = [&](int i, int j) { return rows(lamina.point.p, i, f, j); };
  const T third = (tau(0, 0) + tau(1, 1) + tau(2, 2)) * T(1.0 / 3.0);
  const Sym3<T> dev{tau(0, 0) - third, tau(1, 1) - third, tau(2, 2) - third, tau(0, 1), tau(1, 2), tau(2, 0)};
  return square_root(T(1.5) * contract(dev, dev)) / lamina.point.volume_ratio;
}

}  // namespace standoff::structure
