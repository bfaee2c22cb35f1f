#pragma once
// Parametric gradient of one field in a 64-node hexahedron at its 4x4x4 Gauss points, and the transpose, by sum
// factorisation: values are first carried to the Gauss points along each axis, then differentiated there along each
// axis.
//   du/dxi_d (q) = sum_a dN_a/dxi_d (xi_q) u_a        six contractions of 256 multiply-adds instead of 3 x 4096
//   r_a = sum_q sum_d dN_a/dxi_d (xi_q) t_d(q)        the transpose, the same six in reverse
//
// DATA LAYOUT  one field: T[64], first axis fastest: index = i + 4 j + 16 k, for nodes and for Gauss points.
// Source: Orszag, J. Comput. Phys. 37 (1980) 70, tensor-product evaluation.
#include "structure_solver/elements/cubic_basis.hpp"
#include "structure_solver/elements/lanes.hpp"

namespace standoff::structure {

/// out_q = sum_a M[q][a] in_a along the axis of stride `Stride`; Transposed uses M[a][q]; Add adds to `out`.
template <int Stride, bool Transposed, bool Add, class T>
inline void contract_axis(const Matrix4& m, const T* in, T* out) {
  T matrix[4][4];
#pragma GCC unroll 4
  for (std::size_t q = 0; q < 4; ++q)
#pragma GCC unroll 4
    for (std::size_t a = 0; a < 4; ++a) matrix[q][a] = T(Transposed ? m[a][q] : m[q][a]);
  for (int line = 0; line < 16; ++line) {
    const int base = Stride == 1 ? 4 * line : (Stride == 4 ? (line & 3) + 16 * (line >> 2) : line);
    const T v0 = in[base], v1 = in[base + Stride], v2 = in[base + 2 * Stride], v3 = in[base + 3 * Stride];
#pragma GCC unroll 4
    for (int q = 0; q < 4; ++q) {
      T sum = Add ? fused(matrix[q][0], v0, out[base + q * Stride]) : matrix[q][0] * v0;
      sum = fused(matrix[q][1], v1, sum);
      sum = fused(matrix[q][2], v2, sum);
      out[base + q * Stride] = fused(matrix[q][3], v3, sum);
    }
  }
}

/// Gradient of `nodal` at the Gauss points, one array per parametric direction.
template <class T>
inline void hex64_gradient(const T* nodal, T* d0, T* d1, T* d2) {
  T a[hex_nodes], b[hex_nodes];
  contract_axis<1, false, false>(to_gauss, nodal, a);
  contract_axis<4, false, false>(to_gauss, a, b);
  contract_axis<16, false, false>(to_gauss, b, a);
  contract_axis<1, false, false>(gauss_derivative, a, d0);
  contract_axis<4, false, false>(gauss_derivative, a, d1);
  contract_axis<16, false, false>(gauss_derivative, a, d2);
}

/// Transpose of hex64_gradient: nodal result of the three Gauss-point arrays (weights already inside).
template <class T>
inline void hex64_gradient_transpose(const T* d0, const T* d1, const T* d2, T* nodal) {
  T a[hex_nodes], b[hex_nodes];
  contract_axis<1, true, false>(gauss_derivative, d0, a);
  contract_axis<4, true, true>(gauss_derivative, d1, a);
  contract_axis<16, true, true>(gauss_derivative, d2, a);
  contract_axis<1, true, false>(to_gauss, a, b);
  contract_axis<4, true, false>(to_gauss, b, a);
  contract_axis<16, true, false>(to_gauss, a, nodal);
}

}  // namespace standoff::structure
