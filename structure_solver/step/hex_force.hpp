#pragma once
// Internal force of one hexahedron with N x N x N nodes and Gauss points, or of four side by side (T = Pack4):
//   f = sum_q w_q P(H_q) grad N
// Total Lagrangian: gradients and weights belong to the shape at rest. What the metal answers is asked of `answer`, a
// function of (points, weight, gradient in, stress out): gauss_points.hpp.
//
// DATA LAYOUT  u, force: T[3][N^3] (component, node). gradient: T[3][3][N^3], in place from parametric gradient to
// weighted stress: 18 KiB per pack of the largest element, N = 4, so that what a batch touches stays in the cache.
#include "structure_solver/elements/hex_geometry.hpp"
#include "structure_solver/step/gauss_points.hpp"

namespace standoff::structure {

/// Force at displacement u.
template <class T, class Geometry, class Answer>
inline ElementSums<T> hex_force_of(const Geometry& geometry, const T (&u)[3][Geometry::nodes],
                                   T (&force)[3][Geometry::nodes], Answer&& answer) {
  constexpr int N = Geometry::per_edge, points = Geometry::nodes;
  T gradient[3][3][points];
  T* const first = &gradient[0][0][0];
  double weight[points];
  for (int c = 0; c < 3; ++c) hex_gradient<N>(u[c], gradient[c][0], gradient[c][1], gradient[c][2]);
  for (int q = 0; q < points; ++q) {
    weight[q] = geometry.weight(q);
    store_gradient(geometry.reference_gradient(q, load_gradient(first, points, q)), first, points, q);
  }
  const ElementSums<T> sums = answer(points, weight, first);
  for (int q = 0; q < points; ++q)
    store_gradient(geometry.weighted(q, load_gradient(first, points, q)), first, points, q);
  for (int c = 0; c < 3; ++c) hex_gradient_transpose<N>(gradient[c][0], gradient[c][1], gradient[c][2], force[c]);
  return sums;
}

/// The same for a metal known at compile time; the history is written only if `commit`.
template <class Law, class T, class Geometry>
inline ElementSums<T> hex_force(const MetalParameters& metal, const Geometry& geometry, const PointStep& step,
                                bool commit, const T (&u)[3][Geometry::nodes], T* history,
                                T (&force)[3][Geometry::nodes]) {
  return hex_force_of(geometry, u, force, [&](int points, const double* weight, T* gradient) {
    return update_points<Law>(metal, step, commit, points, weight, gradient, history);
  });
}

}  // namespace standoff::structure
