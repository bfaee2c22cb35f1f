#pragma once
// Internal force of one 8-node hexahedron of a plate, or of four side by side: f = dW/du, W = sum_q w_q w(E_q), with
// the assumed and the enhanced strains of elements/hex8.hpp; w_q an eighth of the volume (2 x 2 x 2 Gauss points).
//   the enhanced strain: r(alpha) = sum_q w_q zeta_q S_zz = 0, by the secant method from the committed alpha, slope at
//   first that of the elastic column, (K + 4/3 G) V / 3. A lane that has converged waits for its neighbours unchanged.
// f = sum_q w_q S : dE/du at fixed alpha: r = 0 makes it the whole slope of W.
//
// DATA LAYOUT  u, force: T[3][8] (component, node)     history: T[8][fields]     alpha: one T per element
#include "structure_solver/elements/hex8.hpp"
#include "structure_solver/elements/hex_geometry.hpp"
#include "structure_solver/step/gauss_points.hpp"

namespace standoff::structure {

inline constexpr int hex8_iterations = 30;
// Residual of alpha, as a strain: a trial without flow is differenced for the stiffness; the return map is good to
// 1e-10 of the yield stress, 2e-13 in strain.
inline constexpr double hex8_tolerance_elastic = 1e-13, hex8_tolerance_flow = 1e-11;

/// What the eight points answer to one alpha.
template <class T>
struct Hex8Points {
  Sym3<T> stress[8];  // second Piola-Kirchhoff
  T residual;
  ElementSums<T> sums;
  T history[8 * most_fields];  // after the step
};

/// `update`: update_points of the metal, with `fields` numbers a point.
template <class T, class Update>
inline void evaluate_points(const MetalParameters& metal, double volume, const PointStep& step,
                            const Sym3<T> (&strain)[8], T alpha, int fields, const T* history, Update update,
                            Hex8Points<T>& out) {
  double weight[8];
  Mat3<T> h[8];
  T gradient[9 * 8];
  for (int q = 0; q < 8; ++q) {
    weight[q] = 0.125 * volume;
    Sym3<T> e = strain[q];
    e.zz = fused(alpha, T(2.0 * hex8_point(q).z), e.zz);
    h[q] = triangular_gradient(e);
    store_gradient(h[q], gradient, 8, q);
  }
  for (int i = 0; i < 8 * fields; ++i) out.history[i] = history[i];
  out.sums = update(metal, step, true, 8, weight, gradient, out.history);
  out.residual = T(0.0);
  for (int q = 0; q < 8; ++q) {
    out.stress[q] = pulled_back(h[q], load_gradient(gradient, 8, q));
    out.residual = fused(T(weight[q] * hex8_point(q).z), out.stress[q].zz, out.residual);
  }
}

/// The points at the alpha that does no work, which is returned.
template <class T, class Update>
inline T relax_thickness(const MetalParameters& metal, double volume, const PointStep& step, const Sym3<T> (&strain)[8],
                         T alpha, int fields, const T* history, Update update, Hex8Points<T>& points) {
  const double column = (metal.bulk + 4.0 / 3.0 * metal.shear) * volume / 3.0;
  const T limit = T(column * (step.flow ? hex8_tolerance_flow : hex8_tolerance_elastic));
  T slope = T(column), before = T(0.0), moved = T(0.0);
  for (int i = 0; i < hex8_iterations; ++i) {
    evaluate_points(metal, volume, step, strain, alpha, fields, history, update, points);
    const T r = points.residual;
    const MaskOf<T> converged = (r <= limit) & (T(0.0) - limit <= r);
    if (!any(invert(converged))) break;
    const T secant = (r - before) / moved;
    if (i > 0) slope = select(secant > T(0.0), smaller(larger(secant, T(0.2 * column)), T(2.0 * column)), slope);
    before = r;
    moved = select(converged, T(0.0), -r / slope);
    alpha = alpha + moved;
  }
  return alpha;
}

/// Forces on the modes from the stresses at the points.
template <class T>
inline void hex8_mode_forces(const T (&u)[3][8], const double (&scale)[3], double weight, const Sym3<T> (&stress)[8],
                             T (&force)[3][8]) {
  for (auto& row : force)
    for (T& value : row) value = T(0.0);
  AcrossStrains<T> s{{T(0.0), T(0.0)}, {T(0.0), T(0.0)}, {T(0.0), T(0.0), T(0.0), T(0.0)}};
  for (int q = 0; q < 8; ++q) {
    const HexPlace p = hex8_point(q);
    const Column3<T> x = stretched(slope(u, 0, p, scale[0]), 0), y = stretched(slope(u, 1, p, scale[1]), 1);
    const T w = T(weight);
    add_slope(force, 0, p, scale[0], w * stress[q].xx, x), add_slope(force, 0, p, scale[0], w * stress[q].xy, y);
    add_slope(force, 1, p, scale[1], w * stress[q].yy, y), add_slope(force, 1, p, scale[1], w * stress[q].xy, x);
    for (int t = 0; t < 2; ++t) {
      s.zx[t] = fused(T(weight * linear_weight(t, p.y)), stress[q].zx, s.zx[t]);
      s.yz[t] = fused(T(weight * linear_weight(t, p.x)), stress[q].yz, s.yz[t]);
    }
    for (int t = 0; t < 4; ++t) s.zz[t] = fused(T(weight * corner_weight(t, p)), stress[q].zz, s.zz[t]);
  }
  auto add_shear = [&](int d, HexPlace p, T factor) {
    add_slope(force, d, p, scale[d], factor, stretched(slope(u, 2, p, scale[2]), 2));
    add_slope(force, 2, p, scale[2], factor, stretched(slope(u, d, p, scale[d]), d));
  };
  for (int t = 0; t < 2; ++t) add_shear(0, shear_zx_place[t], s.zx[t]), add_shear(1, shear_yz_place[t], s.yz[t]);
  for (int t = 0; t < 4; ++t) {
    const HexPlace p = thickness_place[t];
    add_slope(force, 2, p, scale[2], s.zz[t], stretched(slope(u, 2, p, scale[2]), 2));
  }
}

/// det F > 0 at every point, from the displacements: the triangle U would hide an element inside out.
template <class T>
inline MaskOf<T> hex8_upright(const T (&u)[3][8], const double (&scale)[3]) {
  MaskOf<T> upright = Lanes<T>::all_true();
  for (int q = 0; q < 8; ++q) {
    Mat3<T> f;
    for (int d = 0; d < 3; ++d) {
      const Column3<T> column = stretched(slope(u, d, hex8_point(q), scale[d]), d);
      for (int i = 0; i < 3; ++i) f.m[i][d] = column.v[i];
    }
    upright = upright & (rows(f, 0, cofactor(f), 0) > T(0.0));
  }
  return upright;
}

/// Force at displacement u from the history and the enhanced strain, which are written only if `commit`.
template <class T, class Update>
inline ElementSums<T> hex8_force_of(const MetalParameters& metal, const BoxGeometryOf<2>& box, const PointStep& step,
                                    bool commit, const T (&u)[3][8], int fields, T* history, T& alpha, T (&force)[3][8],
                                    Update update) {
  T modes[3][8], mode_force[3][8];
  for (int c = 0; c < 3; ++c) hex8_modes(u[c], modes[c]);
  const AcrossStrains<T> across = across_strains(modes, box.scale);
  Sym3<T> strain[8];
  for (int q = 0; q < 8; ++q) strain[q] = twice_assumed_strain(modes, box.scale, across, hex8_point(q));
  Hex8Points<T> points;
  const T relaxed = relax_thickness(metal, box.volume, step, strain, alpha, fields, history, update, points);
  points.sums.sound = points.sums.sound & hex8_upright(modes, box.scale);
  if (commit) {
    alpha = select(points.sums.sound, relaxed, alpha);
    for (int i = 0; i < 8 * fields; ++i) history[i] = points.history[i];
  }
  hex8_mode_forces(modes, box.scale, 0.125 * box.volume, points.stress, mode_force);
  for (int c = 0; c < 3; ++c) hex8_modes_transpose(mode_force[c], force[c]);
  return points.sums;
}

/// The same for a metal known at compile time.
template <class Law, class T>
inline ElementSums<T> hex8_force(const MetalParameters& metal, const BoxGeometryOf<2>& box, const PointStep& step,
                                 bool commit, const T (&u)[3][8], T* history, T& alpha, T (&force)[3][8]) {
  return hex8_force_of(metal, box, step, commit, u, Law::fields, history, alpha, force, &update_points<Law, T>);
}

}  // namespace standoff::structure
