#pragma once
// A rectangular plate of hexahedra with n nodes along an edge (n = 4: cubic, 64 nodes) on a regular grid, whole or the
// quarter x >= 0, y >= 0.
//
//        z ^  loaded face z = 0          node (i, j, k) -> i + ni (j + nj k), i fastest, k = 0 at the rear face
//   -----------------------> x           element (a, b, c) -> a + nx (b + ny c); its nodes are
//                                      i = (n - 1) a .. (n - 1) (a + 1), ...
//   |    |    |    |    |                spaced like the Lobatto points inside each element
//   ----------------------- z = -thickness
//
// Bent round (pipe_mesh.hpp) the same grid is a quarter of a pipe: x runs round the wall, y along the axis, z from the
// outer face to the inner, which is the loaded one.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "structure_solver/elements/hex_geometry.hpp"
#include "structure_solver/mesh/plate_edges.hpp"

namespace standoff::structure {

struct PlateMeshOptions {
  Vec3 size;                               // m, full plate: width x, width y, thickness
  std::array<int, 3> elements{10, 10, 1};  // full plate
  bool quarter = true;
  std::string edges = "clamped";  // "clamped" | "pinned" | "free" | "symmetry" | "bolted": plate_edges.hpp
  double density = 0.0;           // kg/m3
  double opening = 0.0;           // m, side of the square opening of a frame that bolts the plate
  int nodes_per_edge = 4;         // of an element: 2, 3 or 4
};

struct PlateMesh {
  PlateMeshOptions options;
  std::array<int, 3> elements{};    // simulated
  std::array<int, 3> nodes{};       // simulated, order * elements + 1
  Vec3 lower, edge;                 // m: lowest corner, edges of one element
  std::vector<Vec3> position;       // at rest
  std::vector<double> mass;         // row-sum lumped, kg
  std::vector<std::uint8_t> fixed;  // FixedComponent bits
  std::vector<Hinge> hinges;
  double bend = 0.0;  // m, radius of the middle of the wall of a pipe; 0: flat

  bool bent() const { return bend > 0.0; }
  /// Where a point of the flat grid lies.
  Vec3 place(const Vec3& flat) const;
  /// Unit vector away from the loaded side at nodes (i, ., .).
  Vec3 outward(int i) const;
  /// Width of the layer of nodes k over that of the middle of the thickness.
  double layer_width(int k) const;
  /// Angle about z that carries element e of a pipe onto the first of its layer.
  double angle_to_first(long e) const;
  /// Row-sum mass of node `local` of element e, kg.
  double element_mass(long e, int local) const;

  long element_count() const { return static_cast<long>(elements[0]) * elements[1] * elements[2]; }
  std::size_t node_count() const { return position.size(); }
  int node(int i, int j, int k) const { return i + nodes[0] * (j + nodes[1] * k); }
  int per_edge() const { return options.nodes_per_edge; }
  int order() const { return options.nodes_per_edge - 1; }
  /// Nodes of one element, and its Gauss points.
  int element_nodes() const { return per_edge() * per_edge() * per_edge(); }
  const LineBasis& basis() const { return line_basis_of(per_edge()); }
  /// Node `local` (first axis fastest) of element e.
  int element_node(long e, int local) const {
    const int a = static_cast<int>(e) % elements[0], b = static_cast<int>(e) / elements[0] % elements[1];
    const int c = static_cast<int>(e) / (elements[0] * elements[1]);
    const int n = per_edge(), p = order();
    return node(p * a + local % n, p * b + local / n % n, p * c + local / (n * n));
  }
  BoxGeometry geometry() const { return BoxGeometry::of_edges(edge.x, edge.y, edge.z); }
  /// Position at rest of Gauss point q of element e.
  Vec3 gauss_position(long e, int q) const;
};

/// Throws Stop(bad_case) for a plate that cannot be meshed, with the remedy.
PlateMesh make_plate_mesh(const PlateMeshOptions& options);

}  // namespace standoff::structure
