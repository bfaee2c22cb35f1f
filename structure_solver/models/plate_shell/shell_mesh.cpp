#include "structure_solver/models/plate_shell/shell_mesh.hpp"

#include "structure_solver/elements/mitc4.hpp"

namespace standoff::structure {
namespace {

void hold_node(ShellMesh& mesh, int i, int j) {
  const bool whole = !mesh.options.quarter;
  const bool rim_x = i == mesh.nodes[0] - 1 || (whole && i == 0), rim_y = j == mesh.nodes[1] - 1 || (whole && j == 0);
  unsigned moved = 0, slipped = fixed_z;  // a slip has two components
  const bool mirrors = mesh.options.edges == "symmetry";
  if ((!whole && i == 0) || (mirrors && rim_x)) moved |= fixed_x, slipped |= fixed_x;
  if ((!whole && j == 0) || (mirrors && rim_y)) moved |= fixed_y, slipped |= fixed_y;
  if (mesh.options.edges != "free" && !mirrors && (rim_x || rim_y)) {
    const bool turns = mesh.options.edges == "pinned";
    moved = fixed_all;
    if (!turns || rim_y) slipped |= fixed_x;
    if (!turns || rim_x) slipped |= fixed_y;
  }
  const auto n = static_cast<std::size_t>(mesh.node(i, j));
  mesh.fixed[n] = static_cast<std::uint8_t>(moved), mesh.fixed_slip[n] = static_cast<std::uint8_t>(slipped);
}

/// Row sums of the consistent mass matrix; sum = density times volume.
void lump_mass(ShellMesh& mesh) {
  constexpr double near = 0.5 * (1.0 + 0.57735026918962576), far = 1.0 - near;
  const double areal = mesh.options.density * mesh.options.size.z;
  mesh.mass.assign(mesh.node_count(), 0.0);
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    const ShellGeometry g = ShellGeometry::of_nodes(mesh.corners(e));
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t q = 0; q < 4; ++q) {
        const double shape = a == q ? near * near : (a + q) % 2 == 0 ? far * far : near * far;
        mesh.mass[static_cast<std::size_t>(mesh.quads[e][a])] += areal * shape * lane(g.area, static_cast<int>(q));
      }
  }
}

}  // namespace

ShellMesh make_shell_mesh(const PlateMeshOptions& options) {
  PlateMeshOptions solid = options;
  solid.edges = "free", solid.elements[2] = 1;
  const PlateMesh box = make_plate_mesh(solid);  // checks size, elements and density
  ShellMesh mesh;
  mesh.options = options;
  mesh.elements = {box.elements[0], box.elements[1]};
  mesh.nodes = {box.elements[0] + 1, box.elements[1] + 1};
  for (int j = 0; j < mesh.nodes[1]; ++j)
    for (int i = 0; i < mesh.nodes[0]; ++i)
      mesh.position.push_back({box.lower.x + i * box.edge.x, box.lower.y + j * box.edge.y, 0.0});
  for (int b = 0; b < mesh.elements[1]; ++b)
    for (int a = 0; a < mesh.elements[0]; ++a)
      mesh.quads.push_back({mesh.node(a, b), mesh.node(a + 1, b), mesh.node(a + 1, b + 1), mesh.node(a, b + 1)});
  mesh.fixed.resize(mesh.node_count()), mesh.fixed_slip.resize(mesh.node_count());
  for (int j = 0; j < mesh.nodes[1]; ++j)
    for (int i = 0; i < mesh.nodes[0]; ++i) hold_node(mesh, i, j);
  lump_mass(mesh);
  return mesh;
}

}  // namespace standoff::structure
