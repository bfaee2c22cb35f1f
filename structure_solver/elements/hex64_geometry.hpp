#pragma once
// How an element lies in space at rest: turns parametric gradients into reference gradients, H = du/dX, and weighted
// stresses back. Two kinds with one interface, chosen at compile time:
//   BoxGeometry     edges along the axes: three numbers for the whole element
//   CurvedGeometry  any 64 nodes: inverse Jacobian and weight at each Gauss point
#include "coupling/base/vec3.hpp"
#include "structure_solver/elements/cubic_basis.hpp"
#include "structure_solver/elements/hex64_gradient.hpp"
#include "structure_solver/elements/tensor3.hpp"

namespace standoff::structure {

/// Product of the Gauss weights of point q on the cube [-1, 1]^3.
constexpr double hex_weight(int q) {
  const auto i = static_cast<std::size_t>(q);
  return gauss_weight[i & 3] * gauss_weight[i >> 2 & 3] * gauss_weight[i >> 4];
}

struct BoxGeometry {
  double scale[3];  // 2 / edge length, 1/m
  double volume;    // m3

  static BoxGeometry of_edges(double x, double y, double z) { return {{2.0 / x, 2.0 / y, 2.0 / z}, x * y * z}; }
  double weight(int q) const { return 0.125 * volume * hex_weight(q); }
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

struct CurvedGeometry {
  Mat3<double> inverse[hex_points];  // [d][j] = dxi_d / dX_j
  double point_weight[hex_points];   // Gauss weight times det dX/dxi

  /// From node positions x[3][64].
  static CurvedGeometry of_nodes(const double (&x)[3][hex_nodes]) {
    CurvedGeometry g;
    double d[3][3][hex_points];
    for (int j = 0; j < 3; ++j) hex64_gradient(x[j], d[j][0], d[j][1], d[j][2]);
    for (int q = 0; q < hex_points; ++q) {
      Mat3<double> jacobian;
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) jacobian.m[j][k] = d[j][k][q];
      const Mat3<double> c = cofactor(jacobian);
      const double det = rows(jacobian, 0, c, 0);
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) g.inverse[q].m[k][j] = c.m[j][k] / det;
      g.point_weight[q] = hex_weight(q) * det;
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

}  // namespace standoff::structure
