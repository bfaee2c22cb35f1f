#pragma once
// Parametric gradient of one field in a hexahedron of N x N x N nodes at its N x N x N Gauss points, and the transpose,
// by sum factorisation: values are first carried to the Gauss points along each axis, then differentiated there along
// each axis.
//   du/dxi_d (q) = sum_a dN_a/dxi_d (xi_q) u_a        N = 4: six contractions of 256 multiply-adds, not 3 x 4096
//   r_a = sum_q sum_d dN_a/dxi_d (xi_q) t_d(q)        the transpose, the same six in reverse
//
// DATA LAYOUT  one field: T[N^3], first axis fastest: index = i + N j + N^2 k, for nodes and for Gauss points.
// Source: Orszag, J. Comput. Phys. 37 (1980) 70, tensor-product evaluation.
#include "structure_solver/elements/lanes.hpp"
#include "structure_solver/elements/line_basis.hpp"

namespace standoff::structure {

/// out_q = sum_a M[q][a] in_a along the axis of stride `Stride`; Transposed uses M[a][q]; Add adds to `out`.
template <int N, int Stride, bool Transposed, bool Add, class T>
inline void contract_axis(const Matrix4& m, const T* in, T* out) {
  T matrix[N][N];
#pragma GCC unroll 4
  for (std::size_t q = 0; q < N; ++q)
#pragma GCC unroll 4
    for (std::size_t a = 0; a < N; ++a) matrix[q][a] = T(Transposed ? m[a][q] : m[q][a]);
  for (int line = 0; line < N * N; ++line) {
    const int base = Stride == 1 ? N * line : (Stride == N ? line % N + N * N * (line / N) : line);
    T v[N];
#pragma GCC unroll 4
    for (int a = 0; a < N; ++a) v[a] = in[base + a * Stride];
#pragma GCC unroll 4
    for (int q = 0; q < N; ++q) {
      T sum = Add ? fused(matrix[q][0], v[0], out[base + q * Stride]) : matrix[q][0] * v[0];
#pragma GCC unroll 4
      for (int a = 1; a < N; ++a) sum = fused(matrix[q][a], v[a], sum);
      out[base + q * Stride] = sum;
    }
  }
}

/// Gradient of `nodal` at the Gauss points, one array per parametric direction.
template <int N, class T>
inline void hex_gradient(const T* nodal, T* d0, T* d1, T* d2) {
  constexpr const LineBasis& basis = line_basis<N>;
  T a[N * N * N], b[N * N * N];
  contract_axis<N, 1, false, false>(basis.to_gauss, nodal, a);
  contract_axis<N, N, false, false>(basis.to_gauss, a, b);
  contract_axis<N, N * N, false, false>(basis.to_gauss, b, a);
  contract_axis<N, 1, false, false>(basis.gauss_derivative, a, d0);
  contract_axis<N, N, false, false>(basis.gauss_derivative, a, d1);
  contract_axis<N, N * N, false, false>(basis.gauss_derivative, a, d2);
}

/// Transpose of hex_gradient: nodal result of the three Gauss-point arrays (weights already inside).
template <int N, class T>
inline void hex_gradient_transpose(const T* d0, const T* d1, const T* d2, T* nodal) {
  constexpr const LineBasis& basis = line_basis<N>;
  T a[N * N * N], b[N * N * N];
  contract_axis<N, 1, true, false>(basis.gauss_derivative, d0, a);
  contract_axis<N, N, true, true>(basis.gauss_derivative, d1, a);
  contract_axis<N, N * N, true, true>(basis.gauss_derivative, d2, a);
  contract_axis<N, 1, true, false>(basis.to_gauss, a, b);
  contract_axis<N, N, true, false>(basis.to_gauss, b, a);
  contract_axis<N, N * N, true, false>(basis.to_gauss, a, nodal);
}

}  // namespace standoff::structure
