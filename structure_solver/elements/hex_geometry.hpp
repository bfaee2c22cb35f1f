#pragma once
// How an element lies in space at rest: turns parametric gradients into reference gradients, H = du/dX, and weighted
// stresses back. Two kinds with one interface, chosen at compile time:
//   BoxGeometryOf<N>     edges along the axes: three numbers for the whole element
//   CurvedGeometryOf<N>  any N x N x N nodes: inverse Jacobian and weight at each Gauss point
// BoxGeometry and CurvedGeometry are those of the cubic element, N = 4.
#include "coupling/base/vec3.hpp"
#include "structure_solver/elements/hex_gradient.hpp"
#include "structure_solver/elements/line_basis.hpp"
#include "structure_solver/elements/tensor3.hpp"

namespace standoff::structure {

/// Product of the Gauss weights of point q on the cube [-1, 1]^3.
template <int N>
constexpr double hex_weight(int q) {
  const auto i = static_cast<std::size_t>(q);
  const Line4& weight = line_basis<N>.gauss_weight;
  return weight[i % N] * weight[i / N % N] * weight[i / (N * N)];
}

template <int N>
struct BoxGeometryOf {
  static constexpr int per_edge = N, nodes = N * N * N;
  double scale[3];  // 2 / edge length, 1/m
  double volume;    // m3

  static BoxGeometryOf of_edges(double x, double y, double z) { return {{2.0 / x, 2.0 / y, 2.0 / z}, x * y * z}; }
  /// The box of an element of another order.
  template <int M>
  static BoxGeometryOf of_box(const BoxGeometryOf<M>& b) {
    return {{b.scale[0], b.scale[1], b.scale[2]}, b.volume};
  }
  double weight(int q) const { return 0.125 * volume * hex_weight<N>(q); }
  /// dxi_d / dX at point q, 1/m.
  Vec3 direction(int, int d) const {
    return {d == 0 ? scale[0] : 0.0, d == 1 ? scale[1] : 0.0, d == 2 ? scale[2] : 0.0};
  }
  template <class T>
  Mat3<T> reference_gradient(int, const Mat3<T>& parametric) const {
    Mat3<T> h;
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) h.m[i][d] = parametric.m[i][d] * T(scale[d]);
    return h;
  }
  /// weight * P pulled to parametric directions.
  template <class T>
  Mat3<T> weighted(int q, const Mat3<T>& p) const {
    const double w = weight(q);
    Mat3<T> t;
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) t.m[i][d] = p.m[i][d] * T(w * scale[d]);
    return t;
  }
};

template <int N>
struct CurvedGeometryOf {
  static constexpr int per_edge = N, nodes = N * N * N;
  Mat3<double> inverse[nodes];  // [d][j] = dxi_d / dX_j
  double point_weight[nodes];   // Gauss weight times det dX/dxi

  /// From node positions x[3][N^3].
  static CurvedGeometryOf of_nodes(const double (&x)[3][nodes]) {
    CurvedGeometryOf g;
    double d[3][3][nodes];
    for (int j = 0; j < 3; ++j) hex_gradient<N>(x[j], d[j][0], d[j][1], d[j][2]);
    for (int q = 0; q < nodes; ++q) {
      Mat3<double> jacobian;
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) jacobian.m[j][k] = d[j][k][q];
      const Mat3<double> c = cofactor(jacobian);
      const double det = rows(jacobian, 0, c, 0);
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) g.inverse[q].m[k][j] = c.m[j][k] / det;
      g.point_weight[q] = hex_weight<N>(q) * det;
    }
    return g;
  }
  double weight(int q) const { return point_weight[q]; }
  double volume() const {
    double sum = 0.0;
    for (const double w : point_weight) sum += w;
    return sum;
  }
  Vec3 direction(int q, int d) const { return {inverse[q].m[d][0], inverse[q].m[d][1], inverse[q].m[d][2]}; }
  template <class T>
  Mat3<T> reference_gradient(int q, const Mat3<T>& parametric) const {
    Mat3<T> h;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        T sum = T(0.0);
        for (int d = 0; d < 3; ++d) sum = fused(parametric.m[i][d], T(inverse[q].m[d][j]), sum);
        h.m[i][j] = sum;
      }
    return h;
  }
  template <class T>
  Mat3<T> weighted(int q, const Mat3<T>& p) const {
    Mat3<T> t;
    for (int i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) {
        T sum = T(0.0);
        for (int j = 0; j < 3; ++j) sum = fused(p.m[i][j], T(inverse[q].m[d][j]), sum);
        t.m[i][d] = sum * T(point_weight[q]);
      }
    return t;
  }
};

using BoxGeometry = BoxGeometryOf<4>;
using CurvedGeometry = CurvedGeometryOf<4>;

}  // namespace standoff::structure
