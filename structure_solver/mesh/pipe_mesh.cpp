#include "structure_solver/mesh/pipe_mesh.hpp"

#include <numbers>

#include "coupling/base/stop.hpp"

namespace standoff::structure {
namespace {

void check(const PipeMeshOptions& o) {
  if (!(o.inner_diameter > 0.0 && o.wall > 0.0 && o.length > 0.0))
    throw Stop(ExitCode::bad_case,
               "plate.pipe: inner diameter, wall and length must be longer than zero\n  state all three");
  if (o.ends != "free" && o.ends != "clamped" && o.ends != "symmetry")
    throw Stop(ExitCode::bad_case, "plate.edges = \"" + o.ends + "\" does not exist for the ends of a pipe\n" +
                                       "  edges here: free, clamped, symmetry");
  if (o.elements[0] % 4 != 0)
    throw Stop(ExitCode::bad_case, "plate.elements: " + std::to_string(o.elements[0]) +
                                       " elements round the pipe do not fill four equal quarters\n"
                                       "  choose a multiple of 4");
  if (o.elements[2] > 1 && o.elements[0] / 4 * o.elements[1] % 4 != 0)
    throw Stop(ExitCode::bad_case,
               "plate.elements: with several elements through the wall of a pipe, those of a layer of the quarter must "
               "be a multiple of 4\n  change the number round the pipe or along it");
}

void hold_ends(PlateMesh& mesh, const std::string& ends) {
  const auto held = static_cast<std::uint8_t>(ends == "clamped" ? fixed_all : ends == "symmetry" ? fixed_z : 0);
  for (int k = 0; k < mesh.nodes[2]; ++k)
    for (const int j : {0, mesh.nodes[1] - 1})
      for (int i = 0; i < mesh.nodes[0]; ++i) mesh.fixed[static_cast<std::size_t>(mesh.node(i, j, k))] |= held;
}

}  // namespace

PlateMesh make_pipe_mesh(const PipeMeshOptions& o) {
  check(o);
  const double middle = 0.5 * (o.inner_diameter + o.wall), round = 2.0 * std::numbers::pi * middle;
  PlateMesh mesh = make_plate_mesh(
      {{0.25 * round, o.length, o.wall}, {o.elements[0] / 4, o.elements[1], o.elements[2]}, false, "free", o.density});
  const Vec3 corner = mesh.lower;
  mesh.options.edges = o.ends;
  mesh.options.size.x = round, mesh.options.elements = o.elements, mesh.options.quarter = true;
  mesh.lower.x = mesh.lower.y = 0.0;
  mesh.bend = middle;
  for (Vec3& x : mesh.position) x = mesh.place({x.x - corner.x, x.y - corner.y, x.z});
  for (int k = 0; k < mesh.nodes[2]; ++k)
    for (int j = 0; j < mesh.nodes[1]; ++j) {
      const auto first = static_cast<std::size_t>(mesh.node(0, j, k));
      const auto last = static_cast<std::size_t>(mesh.node(mesh.nodes[0] - 1, j, k));
      mesh.position[first].x = 0.0, mesh.position[last].y = 0.0;  // exactly on the mirror planes
      mesh.fixed[first] |= fixed_x, mesh.fixed[last] |= fixed_y;
    }
  hold_ends(mesh, o.ends);
  for (int k = 0; k < mesh.nodes[2]; ++k)
    for (int j = 0; j < mesh.nodes[1]; ++j)
      for (int i = 0; i < mesh.nodes[0]; ++i)
        mesh.mass[static_cast<std::size_t>(mesh.node(i, j, k))] *= mesh.layer_width(k);
  return mesh;
}

}  // namespace standoff::structure
