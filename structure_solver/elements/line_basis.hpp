#pragma once
// The one-dimensional bases behind the hexahedra with 8, 27 and 64 nodes: Lagrange polynomials on n = 2, 3, 4
// Gauss-Lobatto-Legendre nodes, n Gauss points. Nodes and weights: Abramowitz & Stegun, Handbook of Mathematical
// Functions, tables 25.4, 25.6. Lobatto nodes make the row-sum mass positive and allow a 37 % larger explicit step than
// evenly spaced ones (n = 4; for n <= 3 both are the same).
#include <array>
#include <cstddef>
#include <type_traits>

namespace standoff::structure {

// The cubic element, n = 4, is the largest.
inline constexpr int hex_nodes = 64;   // node a + 4 b + 16 c at (lobatto[a], lobatto[b], lobatto[c])
inline constexpr int hex_points = 64;  // Gauss points, the same order

using Line4 = std::array<double, 4>;  // entries beyond n are zero
using Matrix4 = std::array<Line4, 4>;

/// Values at x of the first n Lagrange polynomials on `nodes`.
constexpr Line4 lagrange(const Line4& nodes, double x, std::size_t n = 4) {
  Line4 values{};
  for (std::size_t a = 0; a < n; ++a) {
    double v = 1.0;
    for (std::size_t b = 0; b < n; ++b)
      if (b != a) v *= (x - nodes[b]) / (nodes[a] - nodes[b]);
    values[a] = v;
  }
  return values;
}

/// Derivatives at x of the first n Lagrange polynomials on `nodes`.
constexpr Line4 lagrange_derivative(const Line4& nodes, double x, std::size_t n = 4) {
  Line4 values{};
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t c = 0; c < n; ++c) {
      if (c == a) continue;
      double v = 1.0 / (nodes[a] - nodes[c]);
      for (std::size_t b = 0; b < n; ++b)
        if (b != a && b != c) v *= (x - nodes[b]) / (nodes[a] - nodes[b]);
      values[a] += v;
    }
  return values;
}

struct LineBasis {
  int nodes = 0;                           // n: nodes of an element along an edge, and Gauss points
  Line4 node{}, weight{};                  // Lobatto
  Line4 gauss_point{}, gauss_weight{};     //
  Matrix4 to_gauss{}, gauss_derivative{};  // nodes -> Gauss points; values there -> derivatives there: row q, column a
  Matrix4 to_even{};                       // nodes -> evenly spaced points; the end rows pick the end nodes exactly

  constexpr Line4 at(double x) const { return lagrange(node, x, static_cast<std::size_t>(nodes)); }
};

constexpr LineBasis make_line_basis(int n, Line4 node, Line4 weight, Line4 gauss_point, Line4 gauss_weight) {
  LineBasis b{n, node, weight, gauss_point, gauss_weight, {}, {}, {}};
  const auto count = static_cast<std::size_t>(n);
  for (std::size_t q = 0; q < count; ++q) {
    b.to_gauss[q] = lagrange(node, gauss_point[q], count);
    b.gauss_derivative[q] = lagrange_derivative(gauss_point, gauss_point[q], count);
    b.to_even[q] = lagrange(node, n == 4 && q == 1 ? -1.0 / 3.0 : n == 4 && q == 2 ? 1.0 / 3.0 : node[q], count);
  }
  return b;
}

template <int N>
inline constexpr LineBasis line_basis = [] {
  static_assert(N >= 2 && N <= 4);
  if constexpr (N == 2)
    return make_line_basis(2, {-1.0, 1.0}, {1.0, 1.0}, {-0.57735026918962576451, 0.57735026918962576451}, {1.0, 1.0});
  else if constexpr (N == 3)
    return make_line_basis(3, {-1.0, 0.0, 1.0}, {1.0 / 3.0, 4.0 / 3.0, 1.0 / 3.0},
                           {-0.77459666924148337704, 0.0, 0.77459666924148337704}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0});
  else
    return make_line_basis(
        4, {-1.0, -0.44721359549995793928, 0.44721359549995793928, 1.0}, {1.0 / 6.0, 5.0 / 6.0, 5.0 / 6.0, 1.0 / 6.0},
        {-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480, 0.86113631159405257522},
        {0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263, 0.34785484513745385737});
}();

/// Calls f(std::integral_constant<int, n>): from the number known at run time to the one the kernels are compiled for.
template <class F>
decltype(auto) with_nodes_per_edge(int n, F&& f) {
  if (n == 2) return f(std::integral_constant<int, 2>{});
  if (n == 3) return f(std::integral_constant<int, 3>{});
  return f(std::integral_constant<int, 4>{});
}

inline const LineBasis& line_basis_of(int n) {
  return with_nodes_per_edge(n, [](auto order) -> const LineBasis& { return line_basis<order()>; });
}

// The cubic basis by its parts.
inline constexpr Line4 lobatto_node = line_basis<4>.node, lobatto_weight = line_basis<4>.weight;
inline constexpr Line4 gauss_point = line_basis<4>.gauss_point, gauss_weight = line_basis<4>.gauss_weight;

}  // namespace standoff::structure
