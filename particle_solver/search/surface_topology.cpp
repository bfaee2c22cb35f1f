#include "particle_solver/search/surface_topology.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "coupling/base/stop.hpp"

namespace standoff::particles {
namespace {

struct Edge {
  std::int32_t low = 0, high = 0, face = 0, side = 0;
};

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

/// All edges of all faces, the two of a shared edge next to each other.
std::vector<Edge> sorted_edges(const SurfaceMesh& mesh, const std::vector<std::int32_t>& weld) {
  std::vector<Edge> edges;
  edges.reserve(4 * mesh.quads.size());
  for (std::size_t f = 0; f < mesh.quads.size(); ++f)
    for (std::size_t e = 0; e < 4; ++e) {
      const std::int32_t a = weld[at(mesh.quads[f][e])], b = weld[at(mesh.quads[f][(e + 1) & 3])];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<std::int32_t>(f), static_cast<std::int32_t>(e)});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.face, a.side) < std::tie(b.low, b.high, b.face, b.side);
  });
  return edges;
}

double mesh_size(const SurfaceMesh& mesh) {
  double size = 0.0;
  for (const Vec3& x : mesh.position) size = std::max({size, std::abs(x.x), std::abs(x.y)});
  return size;
}

void check_mesh(const SurfaceMesh& mesh) {
  const auto nodes = static_cast<std::int32_t>(mesh.position.size());
  if (mesh.quads.empty() || mesh.node_mass.size() != mesh.position.size())
    throw Stop(ExitCode::bad_case, "surface mesh: " + std::to_string(mesh.quads.size()) + " quads, " +
                                       std::to_string(nodes) + " nodes, " + std::to_string(mesh.node_mass.size()) +
                                       " nodal masses; at least one quad and one mass for each node are needed");
  for (const auto& quad : mesh.quads)
    for (const std::int32_t n : quad)
      if (n < 0 || n >= nodes)
        throw Stop(ExitCode::bad_case, "surface mesh: a quad names node " + std::to_string(n) + " of " +
                                           std::to_string(nodes) + "; node numbers run from 0");
  for (std::size_t n = 0; n < mesh.node_mass.size(); ++n)
    if (!(mesh.node_mass[n] > 0.0))
      throw Stop(ExitCode::bad_case, "surface mesh: node " + std::to_string(n) + " has mass " +
                                         std::to_string(mesh.node_mass[n]) + " kg; a positive mass is needed");
}

}  // namespace

RingedMesh add_rigid_ring(SurfaceMesh plate, bool quarter, double half_size) {
  check_mesh(plate);
  RingedMesh result;
  result.weld.resize(plate.position.size());
  std::iota(result.weld.begin(), result.weld.end(), 0);
  const SurfaceTopology topology = surface_topology(plate, result.weld, quarter);
  const std::size_t plate_nodes = plate.position.size(), plate_faces = plate.quads.size();
  result.mesh = std::move(plate);
  if (!(half_size > 0.0)) return result;
  SurfaceMesh& mesh = result.mesh;
  std::vector<std::int32_t> inner(plate_nodes, -1);  // ring node above a plate node; the outer one follows it
  const auto ring_node = [&](std::int32_t n) {
    if (inner[at(n)] < 0) {
      const Vec3 x = mesh.position[at(n)];
      const double extent = std::max(std::abs(x.x), std::abs(x.y));
      if (!(extent > 0.0 && extent < half_size * (1.0 - 1e-9)))
        throw Stop(ExitCode::bad_case, "surround: the plate's edge lies " + std::to_string(extent) +
                                           " m from the axis, the cover plate ends at " + std::to_string(half_size) +
                                           " m; make plate.surround_size larger or set plate.surround = \"open\"");
      const double stretch = half_size / extent;
      inner[at(n)] = static_cast<std::int32_t>(mesh.position.size());
      mesh.position.insert(mesh.position.end(), {x, Vec3{x.x * stretch, x.y * stretch, x.z}});
      mesh.node_mass.insert(mesh.node_mass.end(), 2, std::numeric_limits<double>::infinity());
      result.weld.insert(result.weld.end(), {n, inner[at(n)] + 1});
    }
    return inner[at(n)];
  };
  for (std::size_t f = 0; f < plate_faces; ++f)
    for (std::size_t e = 0; e < 4; ++e) {
      if (topology.neighbour[f][e] != open_rim) continue;
      const std::int32_t a = ring_node(mesh.quads[f][e]), b = ring_node(mesh.quads[f][(e + 1) & 3]);
      mesh.quads.push_back({b, a, a + 1, b + 1});
    }
  return result;
}

SurfaceTopology surface_topology(const SurfaceMesh& mesh, std::vector<std::int32_t> weld, bool quarter) {
  SurfaceTopology t;
  t.weld = std::move(weld);
  const std::size_t nodes = mesh.position.size();
  t.neighbour.assign(mesh.quads.size(), {open_rim, open_rim, open_rim, open_rim});
  t.on_open_rim.assign(nodes, 0), t.on_mirror_x.assign(nodes, 0), t.on_mirror_y.assign(nodes, 0);
  const double near_zero = 1e-9 * mesh_size(mesh);
  for (std::size_t n = 0; quarter && n < nodes; ++n) {
    t.on_mirror_x[n] = std::abs(mesh.position[n].x) <= near_zero;
    t.on_mirror_y[n] = std::abs(mesh.position[n].y) <= near_zero;
  }
  const std::vector<Edge> edges = sorted_edges(mesh, t.weld);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high) ++end;
    const Edge& a = edges[i];
    if (end - i > 2)
      throw Stop(ExitCode::bad_case, "surface mesh: " + std::to_string(end - i) +
                                         " quads share the edge between nodes " + std::to_string(a.low) + " and " +
                                         std::to_string(a.high) + "; a sheet has at most two");
    if (end - i == 2) {
      t.neighbour[at(a.face)][at(a.side)] = edges[i + 1].face;
      t.neighbour[at(edges[i + 1].face)][at(edges[i + 1].side)] = a.face;
    } else if (t.on_mirror_x[at(a.low)] && t.on_mirror_x[at(a.high)]) {
      t.neighbour[at(a.face)][at(a.side)] = mirror_rim_x;
    } else if (t.on_mirror_y[at(a.low)] && t.on_mirror_y[at(a.high)]) {
      t.neighbour[at(a.face)][at(a.side)] = mirror_rim_y;
    } else {
      t.on_open_rim[at(a.low)] = t.on_open_rim[at(a.high)] = 1;
    }
    i = end;
  }
  t.first_face.assign(nodes + 1, 0);
  for (const auto& quad : mesh.quads)
    for (const std::int32_t n : quad) ++t.first_face[at(t.weld[at(n)]) + 1];
  std::partial_sum(t.first_face.begin(), t.first_face.end(), t.first_face.begin());
  t.node_face.resize(4 * mesh.quads.size());
  std::vector<std::int32_t> fill(t.first_face.begin(), t.first_face.end() - 1);
  for (std::size_t f = 0; f < mesh.quads.size(); ++f)
    for (const std::int32_t n : mesh.quads[f])
      t.node_face[at(fill[at(t.weld[at(n)])]++)] = static_cast<std::int32_t>(f);
  return t;
}

}  // namespace standoff::particles
