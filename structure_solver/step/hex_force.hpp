#pragma once
// Internal force of one hexahedron with N x N x N nodes and Gauss points, or of four side by side (T = Pack4):
//   f = sum_q w_q P(H_q) grad N
// Total Lagrangian: gradients and weights belong to the shape at rest.
//
// DATA LAYOUT  u, force: T[3][N^3] (component, node)     history: T[N^3][Law::fields] (Gauss point, field)
// gradient: T[3][3][N^3] (component, direction, point), overwritten in place by the weighted stress: 18 KiB per pack of
// the largest element, N = 4, so that everything a batch touches stays in the first-level cache.
#include "structure_solver/elements/hex_geometry.hpp"
#include "structure_solver/materials/finite_strain_metal.hpp"

namespace standoff::structure {

template <class T>
struct ElementSums {
  T elastic, inelastic;  // J: stored now; work on plastic and thermal strain in this step
  MaskOf<T> sound;       // det F > 0 and finite at every point
};

template <class Law, class T>
inline PointHistory<T> load_history(const MetalParameters& metal, const T* field) {
  PointHistory<T> s;
  s.strain = T(0.0);
  if constexpr (Law::plasticity) {
    s.c = {field[0], field[1], field[2], field[3], field[4], field[5]};
    s.strain = field[Law::strain_field];
  }
  s.temperature = T(metal.flow.room_temperature);
  s.static_stress = T(metal.flow.A);
  s.x = T(0.0);
  if constexpr (Law::temperature_field >= 0) s.temperature = field[Law::temperature_field];
  if constexpr (Law::static_stress_field >= 0) s.static_stress = field[Law::static_stress_field];
  if constexpr (Law::x_field >= 0) s.x = field[Law::x_field];
  return s;
}

template <class Law, class T>
inline void store_history(const PointHistory<T>& s, T* field) {
  field[0] = s.c.xx, field[1] = s.c.yy, field[2] = s.c.zz, field[3] = s.c.xy, field[4] = s.c.yz, field[5] = s.c.zx;
  field[Law::strain_field] = s.strain;
  if constexpr (Law::temperature_field >= 0) field[Law::temperature_field] = s.temperature;
  if constexpr (Law::static_stress_field >= 0) field[Law::static_stress_field] = s.static_stress;
  if constexpr (Law::x_field >= 0) field[Law::x_field] = s.x;
}

template <class T, std::size_t Points>
inline Mat3<T> load_gradient(const T (&gradient)[3][3][Points], int q) {
  Mat3<T> h;
  for (int i = 0; i < 3; ++i)
    for (int d = 0; d < 3; ++d) h.m[i][d] = gradient[i][d][q];
  return h;
}

/// Force at displacement u from the history, which is written only if `commit`.
template <class Law, class T, class Geometry>
inline ElementSums<T> hex_force(const MetalParameters& metal, const Geometry& geometry, const PointStep& step,
                                bool commit, const T (&u)[3][Geometry::nodes], T* history,
                                T (&force)[3][Geometry::nodes]) {
  constexpr int N = Geometry::per_edge, points = Geometry::nodes;
  T gradient[3][3][points];
  for (int c = 0; c < 3; ++c) hex_gradient<N>(u[c], gradient[c][0], gradient[c][1], gradient[c][2]);
  ElementSums<T> sums{T(0.0), T(0.0), Lanes<T>::all_true()};
  for (int q = 0; q < points; ++q) {
    T* const fields = history + q * Law::fields;
    PointHistory<T> s = load_history<Law>(metal, fields);
    const Mat3<T> h = geometry.reference_gradient(q, load_gradient(gradient, q));
    const PointResult<T> point = update_point<Law>(metal, h, step, s);
    if constexpr (Law::plasticity)
      if (commit && any(point.flowed)) store_history<Law>(s, fields);
    const T weight = T(geometry.weight(q));
    sums.elastic = fused(weight, point.elastic, sums.elastic);
    sums.inelastic = fused(weight, point.inelastic, sums.inelastic);
    sums.sound = sums.sound & (point.volume_ratio > T(0.0));
    const Mat3<T> t = geometry.weighted(q, point.p);
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) gradient[i][d][q] = t.m[i][d];
  }
  for (int c = 0; c < 3; ++c) hex_gradient_transpose<N>(gradient[c][0], gradient[c][1], gradient[c][2], force[c]);
  return sums;
}

}  // namespace standoff::structure
