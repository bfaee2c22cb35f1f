#pragma once
// The loaded face of a plate shown as bilinear quads, and the adjoint pair between it and the nodes of the elements:
//   x_s = X_s + N u,   f = N^T f_s     so  f_s . (N u) = f . u  (same work),  sum f = sum f_s  (rows of N sum to one)
// Each face of an element with n nodes an edge carries (n - 1) x (n - 1) evenly spaced quads. The surface nodes are
// evenly spaced, the element nodes are Lobatto points, so N interpolates the element's shape; bilinear weights straight
// onto Lobatto nodes would overload the element corners.
#include <span>
#include <utility>

#include "coupling/contract/surface.hpp"
#include "structure_solver/mesh/plate_mesh.hpp"

namespace standoff::structure {

/// Bilinear quads of the loaded face, evenly spaced in each element, areal mass lumped to their nodes.
SurfaceMesh plate_surface(const PlateMesh& mesh);

/// A sparse matrix by rows; the entries of a row are summed in storage order: same bits for any thread count.
struct SparseRows {
  std::vector<std::int32_t> begin;  // rows + 1
  std::vector<std::int32_t> column;
  std::vector<double> weight;

  Vec3 row_times(std::size_t row, std::span<const Vec3> values) const {
    Vec3 sum;
    for (auto e = static_cast<std::size_t>(begin[row]); e < static_cast<std::size_t>(begin[row + 1]); ++e)
      sum += weight[e] * values[static_cast<std::size_t>(column[e])];
    return sum;
  }
};

class SurfaceMap {
 public:
  explicit SurfaceMap(const PlateMesh& mesh);
  /// Replaces the masses the surface shows [kg], one per surface node.
  void show_inertia(std::vector<double> node_mass) { surface_.node_mass = std::move(node_mass); }
  const SurfaceMesh& surface() const { return surface_; }
  /// N times nodal values.
  void to_surface(std::span<const Vec3> nodal, std::span<Vec3> surface) const;
  /// N^T times surface values; overwrites every node of the mesh.
  void to_nodes(std::span<const Vec3> surface, std::span<Vec3> nodal) const;

 private:
  SurfaceMesh surface_;
  SparseRows forward_;   // one row a surface node
  SparseRows backward_;  // one row a node of the loaded face
  std::size_t first_face_node_;
};

}  // namespace standoff::structure
