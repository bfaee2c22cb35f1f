#pragma once
// A rectangular plate of 4-node quads on a regular grid, whole or the quarter x >= 0, y >= 0.
//
//   node (i, j) -> i + ni j, i fastest          element (a, b) -> a + nx b; nodes counterclockwise seen from the charge
//
// Edges: clamped holds displacement and slip; pinned holds displacement and the slip along the edge; free nothing.
// A quarter holds x on x = 0 and y on y = 0 of both. Positions are those of the loaded face z = 0: the mid-surface
// lies h/2 below it and is shown there, see README.md.
#include <array>

#include "structure_solver/mesh/plate_mesh.hpp"

namespace standoff::structure {

struct ShellMesh {
  PlateMeshOptions options;
  std::array<int, 2> elements{}, nodes{};          // simulated
  std::vector<Vec3> position;                      // at rest, z = 0
  std::vector<std::array<std::int32_t, 4>> quads;  // counterclockwise
  std::vector<double> mass;                        // lumped, kg
  std::vector<std::uint8_t> fixed, fixed_slip;     // FixedComponent bits

  std::size_t node_count() const { return position.size(); }
  long element_count() const { return static_cast<long>(quads.size()); }
  std::int32_t node(int i, int j) const { return i + nodes[0] * j; }
  std::array<Vec3, 4> corners(std::size_t element) const {
    const auto& q = quads[element];
    const auto at = [&](std::size_t a) { return position[static_cast<std::size_t>(q[a])]; };
    return {at(0), at(1), at(2), at(3)};
  }
};

/// Throws Stop(bad_case) for a plate that cannot be meshed, with the remedy.
ShellMesh make_shell_mesh(const PlateMeshOptions& options);

}  // namespace standoff::structure
