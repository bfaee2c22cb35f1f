#pragma once
// Order of the 64 points of VTK's cubic Lagrange hexahedron (cell type 72) as written in files of version 2.2: corners,
// edges, faces, inside. VTK's points are evenly spaced in parametric space. Source: VTK 9.1,
// vtkHigherOrderHexahedron::PointIndexFromIJK; corners as in VTK_HEXAHEDRON, edges and faces along the axes.
#include <array>

namespace standoff::structure {

/// Place in VTK's list of the point (i, j, k), each 0..3.
constexpr int vtk_cubic_index(int i, int j, int k) {
  const bool on_i = i == 0 || i == 3, on_j = j == 0 || j == 3, on_k = k == 0 || k == 3;
  const bool hi = i > 0, hj = j > 0, hk = k > 0;
  const int corner = hi ? (hj ? 2 : 1) : (hj ? 3 : 0);  // ring around the k axis
  const int boundaries = on_i + on_j + on_k;
  if (boundaries == 3) return corner + (hk ? 4 : 0);
  if (boundaries == 2) {  // edges: two points each, 4 around the bottom, 4 around the top, 4 upright
    if (!on_i) return 8 + (i - 1) + (hj ? 4 : 0) + (hk ? 8 : 0);
    if (!on_j) return 8 + (j - 1) + (hi ? 2 : 6) + (hk ? 8 : 0);
    return 24 + (k - 1) + 2 * corner;
  }
  if (boundaries == 1) {  // faces: four points each
    if (on_i) return 32 + (j - 1) + 2 * (k - 1) + (hi ? 4 : 0);
    if (on_j) return 40 + (i - 1) + 2 * (k - 1) + (hj ? 4 : 0);
    return 48 + (i - 1) + 2 * (j - 1) + (hk ? 4 : 0);
  }
  return 56 + (i - 1) + 2 * (j - 1) + 4 * (k - 1);
}

/// vtk_cubic_order[place] = i + 4 j + 16 k
inline constexpr std::array<int, 64> vtk_cubic_order = [] {
  std::array<int, 64> order{};
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) order[static_cast<std::size_t>(vtk_cubic_index(i, j, k))] = i + 4 * j + 16 * k;
  return order;
}();

}  // namespace standoff::structure
