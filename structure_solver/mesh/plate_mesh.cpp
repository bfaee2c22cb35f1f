#include "structure_solver/mesh/plate_mesh.hpp"

#include <cmath>

#include "coupling/base/stop.hpp"

namespace standoff::structure {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw Stop(ExitCode::bad_case, text);
}

void check(const PlateMeshOptions& o) {
  if (!(o.size.x > 0.0 && o.size.y > 0.0 && o.size.z > 0.0))
    refuse("plate.size: every edge must be longer than zero\n  give width x, width y and thickness");
  for (const int n : o.elements)
    if (n < 1) refuse("plate.elements: " + std::to_string(n) + " elements along an axis; at least 1 is needed");
  if (o.quarter && (o.elements[0] % 2 != 0 || o.elements[1] % 2 != 0))
    refuse("plate.elements: a quarter model needs an even number of elements across the full plate, not " +
           std::to_string(o.elements[0]) + " x " + std::to_string(o.elements[1]) +
           "\n  choose even numbers, or run.symmetry = \"none\"");
  if (!(o.density > 0.0)) refuse("plate.material: the density must be positive");
}

/// Lobatto coordinates along one axis of n elements.
std::vector<double> axis_positions(const LineBasis& basis, double lower, double edge, int n) {
  std::vector<double> x;
  for (int e = 0; e < n; ++e)
    for (std::size_t a = 0; a + 1 < static_cast<std::size_t>(basis.nodes); ++a)
      x.push_back(lower + edge * (e + 0.5 * (1.0 + basis.node[a])));
  x.push_back(lower + edge * n);
  return x;
}

/// Lobatto weights assembled along one axis, sum = length.
std::vector<double> axis_weights(const LineBasis& basis, double edge, int n) {
  const auto count = static_cast<std::size_t>(basis.nodes), order = count - 1;
  std::vector<double> w(order * static_cast<std::size_t>(n) + 1, 0.0);
  for (std::size_t e = 0; e < static_cast<std::size_t>(n); ++e)
    for (std::size_t a = 0; a < count; ++a) w[order * e + a] += 0.5 * edge * basis.weight[a];
  return w;
}

}  // namespace

Vec3 PlateMesh::place(const Vec3& flat) const {
  if (!bent()) return flat;
  const double radius = bend - 0.5 * options.size.z - flat.z, angle = flat.x / bend;
  return {radius * std::sin(angle), radius * std::cos(angle), flat.y};
}

Vec3 PlateMesh::outward(int i) const {
  if (!bent()) return {0.0, 0.0, -1.0};
  const Vec3& x = position[static_cast<std::size_t>(i)];
  const double radius = std::hypot(x.x, x.y);
  return {x.x / radius, x.y / radius, 0.0};
}

double PlateMesh::layer_width(int k) const {
  if (!bent()) return 1.0;
  const Vec3& x = position[static_cast<std::size_t>(node(0, 0, k))];
  return std::hypot(x.x, x.y) / bend;
}

double PlateMesh::angle_to_first(long e) const {
  return bent() ? static_cast<double>(e % elements[0]) * edge.x / bend : 0.0;
}

double PlateMesh::element_mass(long e, int local) const {
  const auto a = static_cast<std::size_t>(local);
  const int layer = static_cast<int>(e / (static_cast<long>(elements[0]) * elements[1]));
  const auto n = static_cast<std::size_t>(per_edge());
  const Line4& weight = basis().weight;
  return options.density * 0.125 * geometry().volume * weight[a % n] * weight[a / n % n] * weight[a / (n * n)] *
         layer_width(order() * layer + local / (per_edge() * per_edge()));
}

Vec3 PlateMesh::gauss_position(long e, int q) const {
  const int a = static_cast<int>(e) % elements[0], b = static_cast<int>(e) / elements[0] % elements[1];
  const int c = static_cast<int>(e) / (elements[0] * elements[1]);
  const LineBasis& line = basis();
  auto along = [&](double low, double length, int n, int point) {
    return low + length * (n + 0.5 * (1.0 + line.gauss_point[static_cast<std::size_t>(point)]));
  };
  const int m = per_edge();
  return place(
      {along(lower.x, edge.x, a, q % m), along(lower.y, edge.y, b, q / m % m), along(lower.z, edge.z, c, q / (m * m))});
}

PlateMesh make_plate_mesh(const PlateMeshOptions& options) {
  check(options);
  PlateMesh mesh;
  mesh.options = options;
  mesh.elements = options.elements;
  mesh.edge = {options.size.x / options.elements[0], options.size.y / options.elements[1],
               options.size.z / options.elements[2]};
  mesh.lower = {-0.5 * options.size.x, -0.5 * options.size.y, -options.size.z};
  if (options.quarter) {
    mesh.elements[0] /= 2, mesh.elements[1] /= 2;
    mesh.lower.x = mesh.lower.y = 0.0;
  }
  for (std::size_t d = 0; d < 3; ++d) mesh.nodes[d] = mesh.order() * mesh.elements[d] + 1;

  const auto x = axis_positions(mesh.basis(), mesh.lower.x, mesh.edge.x, mesh.elements[0]);
  const auto y = axis_positions(mesh.basis(), mesh.lower.y, mesh.edge.y, mesh.elements[1]);
  auto z = axis_positions(mesh.basis(), mesh.lower.z, mesh.edge.z, mesh.elements[2]);
  z.back() = 0.0;  // the loaded face, exactly
  const auto wx = axis_weights(mesh.basis(), mesh.edge.x, mesh.elements[0]);
  const auto wy = axis_weights(mesh.basis(), mesh.edge.y, mesh.elements[1]);
  const auto wz = axis_weights(mesh.basis(), mesh.edge.z, mesh.elements[2]);
  for (std::size_t k = 0; k < z.size(); ++k)
    for (std::size_t j = 0; j < y.size(); ++j)
      for (std::size_t i = 0; i < x.size(); ++i) {
        mesh.position.push_back({x[i], y[j], z[k]});
        mesh.mass.push_back(options.density * wx[i] * wy[j] * wz[k]);
      }
  hold_edges(mesh);
  return mesh;
}

}  // namespace standoff::structure
