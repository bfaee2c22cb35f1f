#include "structure_solver/mesh/surface_map.hpp"

#include <algorithm>

namespace standoff::structure {
namespace {

/// Evenly spaced surface line s = 0 .. order n: element nodes and weights that make its position.
struct LineWeights {
  int first;  // index of the first node of the element along the axis
  Line4 weight;
};

LineWeights line_weights(const LineBasis& basis, int s, int elements) {
  const int order = basis.nodes - 1, element = std::min(s / order, elements - 1);
  return {order * element, basis.to_even[static_cast<std::size_t>(s - order * element)]};
}

double even_position(double lower, double edge, int s, int order) {
  return lower + edge * s / order;
}

/// Width that belongs to line s of 0 .. last, quads of width `quad`.
double tributary(int s, int last, double quad) {
  return s == 0 || s == last ? 0.5 * quad : quad;
}

SparseRows forward_rows(const PlateMesh& mesh) {
  SparseRows n;
  n.begin.push_back(0);
  const int top = mesh.nodes[2] - 1;
  for (int t = 0; t < mesh.nodes[1]; ++t)
    for (int s = 0; s < mesh.nodes[0]; ++s) {
      const LineWeights x = line_weights(mesh.basis(), s, mesh.elements[0]);
      const LineWeights y = line_weights(mesh.basis(), t, mesh.elements[1]);
      for (int b = 0; b < mesh.per_edge(); ++b)
        for (int a = 0; a < mesh.per_edge(); ++a) {
          const double w = x.weight[static_cast<std::size_t>(a)] * y.weight[static_cast<std::size_t>(b)];
          if (w == 0.0) continue;
          n.column.push_back(mesh.node(x.first + a, y.first + b, top));
          n.weight.push_back(w);
        }
      n.begin.push_back(static_cast<std::int32_t>(n.column.size()));
    }
  return n;
}

/// Transpose of `n`, columns counted from `first`, `count` of them.
SparseRows transposed(const SparseRows& n, std::size_t first, std::size_t count) {
  SparseRows t;
  t.begin.assign(count + 1, 0);
  for (const std::int32_t c : n.column) ++t.begin[static_cast<std::size_t>(c) - first + 1];
  for (std::size_t i = 0; i < count; ++i) t.begin[i + 1] += t.begin[i];
  t.column.resize(n.column.size());
  t.weight.resize(n.column.size());
  std::vector<std::int32_t> next(t.begin.begin(), t.begin.end() - 1);
  for (std::size_t row = 0; row + 1 < n.begin.size(); ++row)
    for (auto e = static_cast<std::size_t>(n.begin[row]); e < static_cast<std::size_t>(n.begin[row + 1]); ++e) {
      const auto slot = static_cast<std::size_t>(next[static_cast<std::size_t>(n.column[e]) - first]++);
      t.column[slot] = static_cast<std::int32_t>(row);
      t.weight[slot] = n.weight[e];
    }
  return t;
}

}  // namespace

SurfaceMesh plate_surface(const PlateMesh& mesh) {
  SurfaceMesh surface;
  const int ni = mesh.nodes[0], nj = mesh.nodes[1];
  const double areal = mesh.options.density * mesh.options.size.z;
  for (int t = 0; t < nj; ++t)
    for (int s = 0; s < ni; ++s) {
      surface.position.push_back({even_position(mesh.lower.x, mesh.edge.x, s, mesh.order()),
                                  even_position(mesh.lower.y, mesh.edge.y, t, mesh.order()), 0.0});
      surface.node_mass.push_back(areal * tributary(s, ni - 1, mesh.edge.x / mesh.order()) *
                                  tributary(t, nj - 1, mesh.edge.y / mesh.order()));
    }
  for (int t = 0; t + 1 < nj; ++t)
    for (int s = 0; s + 1 < ni; ++s) {
      const int corner = s + ni * t;
      surface.quads.push_back({corner, corner + 1, corner + ni + 1, corner + ni});
    }
  return surface;
}

SurfaceMap::SurfaceMap(const PlateMesh& mesh)
    : surface_(plate_surface(mesh)),
      forward_(forward_rows(mesh)),
      first_face_node_(static_cast<std::size_t>(mesh.node(0, 0, mesh.nodes[2] - 1))) {
  if (mesh.bent()) to_surface(mesh.position, surface_.position);
  backward_ = transposed(forward_, first_face_node_, mesh.node_count() - first_face_node_);
}

void SurfaceMap::to_surface(std::span<const Vec3> nodal, std::span<Vec3> surface) const {
  for (std::size_t i = 0; i < surface.size(); ++i) surface[i] = forward_.row_times(i, nodal);
}

void SurfaceMap::to_nodes(std::span<const Vec3> surface, std::span<Vec3> nodal) const {
  std::fill(nodal.begin(), nodal.begin() + static_cast<std::ptrdiff_t>(first_face_node_), Vec3{});
  for (std::size_t i = first_face_node_; i < nodal.size(); ++i)
    nodal[i] = backward_.row_times(i - first_face_node_, surface);
}

}  // namespace standoff::structure
