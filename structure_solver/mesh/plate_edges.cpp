#include "structure_solver/mesh/plate_edges.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/base/stop.hpp"
#include "structure_solver/mesh/plate_mesh.hpp"

namespace standoff::structure {
namespace {

/// Which rims the node column (i, j) lies on.
struct Rim {
  bool x, y;
};

Rim rim_of(const PlateMesh& mesh, int i, int j) {
  const bool whole = !mesh.options.quarter;
  return {i == mesh.nodes[0] - 1 || (whole && i == 0), j == mesh.nodes[1] - 1 || (whole && j == 0)};
}

unsigned mirror_planes(const PlateMesh& mesh, int i, int j) {
  unsigned bits = 0;
  if (mesh.options.quarter && i == 0) bits |= fixed_x;
  if (mesh.options.quarter && j == 0) bits |= fixed_y;
  return bits;
}

/// The component normal to a pinned edge turns about the mid-surface: layer k against its mirror image.
void add_hinges(PlateMesh& mesh, int i, int j, double Vec3::*normal, std::uint8_t bit) {
  const int last = mesh.nodes[2] - 1;
  for (int k = 0; 2 * k < last; ++k) mesh.hinges.push_back({mesh.node(i, j, k), mesh.node(i, j, last - k), normal});
  if (last % 2 == 0) mesh.fixed[static_cast<std::size_t>(mesh.node(i, j, last / 2))] |= bit;
}

unsigned held_when_pinned(Rim rim) {
  unsigned bits = 0;
  if (rim.x) bits |= fixed_y | fixed_z;
  if (rim.y) bits |= fixed_x | fixed_z;
  return bits;
}

void hold_column(PlateMesh& mesh, int i, int j) {
  const std::string& edges = mesh.options.edges;
  const Rim rim = rim_of(mesh, i, j);
  unsigned through = mirror_planes(mesh, i, j), on_faces = 0;
  if (edges == "clamped" && (rim.x || rim.y)) through |= fixed_all;
  if (edges == "pinned") through |= held_when_pinned(rim);
  if (edges == "symmetry" && rim.x) through |= fixed_x;
  if (edges == "symmetry" && rim.y) through |= fixed_y;
  if (edges == "bolted") {
    const Vec3& at = mesh.position[static_cast<std::size_t>(mesh.node(i, j, 0))];
    const double rounding = 1e-9 * mesh.edge.x;
    if (std::max(std::fabs(at.x) - free_half_width(mesh, 0), std::fabs(at.y) - free_half_width(mesh, 1)) > -rounding)
      on_faces = fixed_all;
  }
  const int last = mesh.nodes[2] - 1;
  for (int k = 0; k <= last; ++k)
    mesh.fixed[static_cast<std::size_t>(mesh.node(i, j, k))] =
        static_cast<std::uint8_t>(through | (k == 0 || k == last ? on_faces : 0u));
  if (edges == "pinned" && rim.x && !rim.y) add_hinges(mesh, i, j, &Vec3::x, fixed_x);
  if (edges == "pinned" && rim.y && !rim.x) add_hinges(mesh, i, j, &Vec3::y, fixed_y);
}

}  // namespace

double free_half_width(const PlateMesh& mesh, int axis) {
  const double half = 0.5 * (axis == 0 ? mesh.options.size.x : mesh.options.size.y);
  if (mesh.options.edges != "bolted") return half;
  double nearest = half;
  for (int i = 0; i < mesh.nodes[static_cast<std::size_t>(axis)]; ++i) {
    const Vec3& at = mesh.position[static_cast<std::size_t>(axis == 0 ? mesh.node(i, 0, 0) : mesh.node(0, i, 0))];
    const double line = std::fabs(axis == 0 ? at.x : at.y), wanted = 0.5 * mesh.options.opening;
    if (std::fabs(line - wanted) < std::fabs(nearest - wanted)) nearest = line;
  }
  return nearest;
}

void hold_edges(PlateMesh& mesh) {
  const std::string& edges = mesh.options.edges;
  if (edges != "clamped" && edges != "pinned" && edges != "free" && edges != "symmetry" && edges != "bolted")
    throw Stop(ExitCode::bad_case, "plate.edges = \"" + edges + "\" does not exist for solid elements\n" +
                                       "  edges here: clamped, pinned, free, symmetry, bolted");
  mesh.fixed.assign(mesh.node_count(), 0);
  for (int j = 0; j < mesh.nodes[1]; ++j)
    for (int i = 0; i < mesh.nodes[0]; ++i) hold_column(mesh, i, j);
}

}  // namespace standoff::structure
