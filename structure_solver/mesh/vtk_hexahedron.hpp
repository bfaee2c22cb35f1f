#pragma once
// Order of the points of VTK's Lagrange hexahedron of order p (cell type 72) as written in files of version 2.2:
// corners, edges, faces, inside. VTK's points are evenly spaced in parametric space. Source: VTK 9.1,
// vtkHigherOrderHexahedron::PointIndexFromIJK; corners as in VTK_HEXAHEDRON, edges and faces along the axes.
#include <array>

namespace standoff::structure {

/// Place in VTK's list of the point (i, j, k), each 0..p.
constexpr int vtk_hexahedron_index(int p, int i, int j, int k) {
  const int m = p - 1;  // points inside an edge
  const bool on_i = i == 0 || i == p, on_j = j == 0 || j == p, on_k = k == 0 || k == p;
  const bool hi = i > 0, hj = j > 0, hk = k > 0;
  const int corner = hi ? (hj ? 2 : 1) : (hj ? 3 : 0);  // ring around the k axis
  const int boundaries = on_i + on_j + on_k;
  if (boundaries == 3) return corner + (hk ? 4 : 0);
  if (boundaries == 2) {  // edges: m points each, 4 around the bottom, 4 around the top, 4 upright
    if (!on_i) return 8 + (i - 1) + (hj ? 2 * m : 0) + (hk ? 4 * m : 0);
    if (!on_j) return 8 + (j - 1) + (hi ? m : 3 * m) + (hk ? 4 * m : 0);
    return 8 + 8 * m + (k - 1) + m * corner;
  }
  const int faces = 8 + 12 * m;
  if (boundaries == 1) {  // faces: m x m points each
    if (on_i) return faces + (j - 1) + m * (k - 1) + (hi ? m * m : 0);
    if (on_j) return faces + 2 * m * m + (i - 1) + m * (k - 1) + (hj ? m * m : 0);
    return faces + 4 * m * m + (i - 1) + m * (j - 1) + (hk ? m * m : 0);
  }
  return faces + 6 * m * m + (i - 1) + m * (j - 1) + m * m * (k - 1);
}

/// vtk_order<N>[place] = i + N j + N^2 k of an element with N nodes along an edge. N = 2: VTK's plain hexahedron (type
/// 12).
template <int N>
inline constexpr std::array<int, N * N * N> vtk_order = [] {
  std::array<int, N * N * N> order{};
  for (int k = 0; k < N; ++k)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < N; ++i)
        order[static_cast<std::size_t>(vtk_hexahedron_index(N - 1, i, j, k))] = i + N * j + N * N * k;
  return order;
}();

}  // namespace standoff::structure
