#include "structure_solver/mesh/surface_inertia.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::structure {
namespace {

constexpr double fixed_factor = 1e6;

/// Lumped widths [m] of the element nodes along a line of `elements` of length `edge`; the Lobatto weights.
std::vector<double> node_widths(const LineBasis& basis, int elements, double edge) {
  const int order = basis.nodes - 1;
  std::vector<double> width(static_cast<std::size_t>(order * elements + 1), 0.0);
  for (int e = 0; e < elements; ++e)
    for (int a = 0; a < basis.nodes; ++a)
      width[static_cast<std::size_t>(order * e + a)] += 0.5 * edge * basis.weight[static_cast<std::size_t>(a)];
  return width;
}

/// Row s of N along the line: weights on element nodes, zero elsewhere.
std::vector<double> surface_row(const LineBasis& basis, int s, int elements) {
  const int order = basis.nodes - 1;
  std::vector<double> row(static_cast<std::size_t>(order * elements + 1), 0.0);
  const int element = std::min(s / order, elements - 1);
  const Line4& weight = basis.to_even[static_cast<std::size_t>(s - order * element)];
  for (int a = 0; a < basis.nodes; ++a)
    row[static_cast<std::size_t>(order * element + a)] = weight[static_cast<std::size_t>(a)];
  return row;
}

/// Effective width of every surface node along one axis; `fixed` marks element nodes that do not move.
std::vector<double> effective_widths(const LineBasis& basis, int elements, double edge,
                                     const std::vector<bool>& fixed) {
  const std::vector<double> width = node_widths(basis, elements, edge);
  const int order = basis.nodes - 1, last = order * elements;
  const double quad = edge / order;
  auto a_entry = [&](int s, int t) {
    const std::vector<double> ns = surface_row(basis, s, elements), nt = surface_row(basis, t, elements);
    double sum = 0.0;
    for (std::size_t i = 0; i < width.size(); ++i)
      if (!fixed[i]) sum += ns[i] * nt[i] / width[i];
    return sum;
  };
  std::vector<double> result;
  for (int s = 0; s <= last; ++s) {
    const bool border = s == 0 || s == last;
    const double diagonal = border ? quad / 3.0 : 2.0 * quad / 3.0, neighbour = quad / 6.0;
    double inverse = a_entry(s, s);
    if (s > 0) inverse += a_entry(s, s - 1) * neighbour / diagonal;
    if (s < last) inverse += a_entry(s, s + 1) * neighbour / diagonal;
    const double tributary = border ? 0.5 * quad : quad;
    result.push_back(inverse > 0.0 ? std::min(1.0 / inverse, fixed_factor * tributary) : fixed_factor * tributary);
  }
  return result;
}

/// Share of the loaded face's own layer of nodes in the mass through the thickness.
double face_share(const PlateMesh& mesh) {
  return node_widths(mesh.basis(), mesh.elements[2], mesh.edge.z).back() / mesh.options.size.z;
}

/// Which element nodes along an axis are held against the load: `at(i)` is the node index in the mesh.
template <class At>
std::vector<bool> held_line(const PlateMesh& mesh, int count, const At& at) {
  const unsigned normal = mesh.bent() ? fixed_x | fixed_y : fixed_z;
  std::vector<bool> held;
  for (int i = 0; i < count; ++i) held.push_back((mesh.fixed[static_cast<std::size_t>(at(i))] & normal) == normal);
  return held;
}

}  // namespace

std::vector<double> surface_inertia(const PlateMesh& mesh, double wave_speed, double answer_time) {
  const int middle_x = mesh.nodes[0] / 2, middle_y = mesh.nodes[1] / 2, top = mesh.nodes[2] - 1;
  const auto held_x = held_line(mesh, mesh.nodes[0], [&](int i) { return mesh.node(i, middle_y, top); });
  const auto held_y = held_line(mesh, mesh.nodes[1], [&](int j) { return mesh.node(middle_x, j, top); });
  const std::vector<double> along_x = effective_widths(mesh.basis(), mesh.elements[0], mesh.edge.x, held_x);
  const std::vector<double> along_y = effective_widths(mesh.basis(), mesh.elements[1], mesh.edge.y, held_y);
  const double there_and_back = 2.0 * mesh.options.size.z / wave_speed;
  const double answering = std::clamp(answer_time / there_and_back, face_share(mesh), 1.0);
  const double areal = mesh.options.density * mesh.options.size.z * answering;
  std::vector<double> mass;
  for (const double y : along_y)
    for (const double x : along_x) mass.push_back(areal * x * y);
  return mass;
}

}  // namespace standoff::structure
