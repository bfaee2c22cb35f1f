#include "structure_solver/step/internal_force.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::structure {
namespace {

/// Static flow stress of the virgin metal. A table starts at A; B p^n is not quite zero at the smallest p it knows.
double initial_flow(const MetalParameters& metal, Hardening hardening) {
  if (hardening != Hardening::power) return metal.flow.A;
  return static_flow<Hardening::power, false>(metal.flow, 0.0, metal.flow.room_temperature).stress;
}

}  // namespace

InternalForce::InternalForce(const PlateMesh& mesh, const MetalParameters& metal, const MetalEffects& effects,
                             int threads)
    : mesh_(mesh),
      metal_(metal),
      law_(choose_point_law(effects, widest_here())),
      kernel_(choose_element_kernel({mesh.per_edge(), mesh.bent()})),
      threads_(threads),
      count_(static_cast<std::size_t>(mesh.element_nodes())),
      component_stride_(static_cast<std::ptrdiff_t>(4 * count_)) {
  const long elements = mesh.element_count(), count = (elements + 3) / 4;
  const int local_nodes = mesh.element_nodes();
  sums_.resize(static_cast<std::size_t>(count));
  nodes_.resize(sums_.size() * 4 * count_);
  shape_batches();
  if (mesh.per_edge() == 2) enhanced_.assign(sums_.size(), Pack4(0.0));
  buffer_.resize(sums_.size() * 3 * count_);
  node_begin_.assign(mesh.node_count() + 1, 0);
  for (long e = 0; e < 4 * count; ++e)
    for (int a = 0; a < local_nodes; ++a) {
      const int node = mesh.element_node(std::min(e, elements - 1), a);
      nodes_[static_cast<std::size_t>(e / 4 * local_nodes + a) * 4 + static_cast<std::size_t>(e % 4)] = node;
      if (e < elements) ++node_begin_[static_cast<std::size_t>(node) + 1];
    }
  for (std::size_t i = 0; i < mesh.node_count(); ++i) node_begin_[i + 1] += node_begin_[i];
  node_entry_.resize(static_cast<std::size_t>(node_begin_.back()));
  std::vector<std::int32_t> next(node_begin_.begin(), node_begin_.end() - 1);
  for (long e = 0; e < elements; ++e)
    for (int a = 0; a < local_nodes; ++a)
      node_entry_[static_cast<std::size_t>(next[static_cast<std::size_t>(mesh.element_node(e, a))]++)] =
          static_cast<std::int32_t>((e / 4 * 3 * local_nodes + a) * 4 + e % 4);

  const HistoryLayout& layout = law_.layout;
  history_.assign(sums_.size() * count_ * static_cast<std::size_t>(layout.fields), Pack4(0.0));
  const double static_stress = initial_flow(metal, effects.hardening);
  for (std::size_t row = 0; row < history_.size(); row += static_cast<std::size_t>(layout.fields)) {
    if (layout.temperature >= 0)
      history_[row + static_cast<std::size_t>(layout.temperature)] = metal.flow.room_temperature;
    if (layout.static_stress >= 0) history_[row + static_cast<std::size_t>(layout.static_stress)] = static_stress;
  }
}

/// Elements of a pipe are copies of the first of their layer of the wall, each turned by the angle of its column.
void InternalForce::shape_batches() {
  const BoxGeometry box = mesh_.geometry();
  shapes_.assign(sums_.size(), BatchShape{box, nullptr, Pack4(1.0), Pack4(0.0)});
  if (!mesh_.bent()) return;
  const long layer = static_cast<long>(mesh_.elements[0]) * mesh_.elements[1];
  for (long e = 0; e < mesh_.element_count(); e += layer) {
    double x[3][hex_nodes];
    for (int a = 0; a < hex_nodes; ++a) {
      const Vec3& at = mesh_.position[static_cast<std::size_t>(mesh_.element_node(e, a))];
      x[0][a] = at.x, x[1][a] = at.y, x[2][a] = at.z;
    }
    curved_.push_back(CurvedGeometry::of_nodes(x));
  }
  for (std::size_t b = 0; b < shapes_.size(); ++b) {
    const long first = 4 * static_cast<long>(b);
    shapes_[b].curved = &curved_[static_cast<std::size_t>(first / layer)];
    for (int i = 0; i < 4; ++i) {
      const double angle = mesh_.angle_to_first(std::min(first + i, mesh_.element_count() - 1));
      set_lane(shapes_[b].cosine, i, std::cos(angle)), set_lane(shapes_[b].sine, i, std::sin(angle));
    }
  }
}

ForceSums InternalForce::evaluate(std::span<const Vec3> u, const PointStep& step, bool commit) {
  const auto history_stride = count_ * static_cast<std::size_t>(law_.layout.fields);
  const auto count = sums_.size();
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t b = 0; b < count; ++b)
    sums_[b] = kernel_(metal_, law_, shapes_[b], step, commit, u.data(), &nodes_[b * 4 * count_],
                       history_.data() + b * history_stride, alpha_of(b), &buffer_[b * 3 * count_]);
  ForceSums total;
  const long elements = mesh_.element_count();
  for (long e = 0; e < elements; ++e) {
    const BatchSums& s = sums_[static_cast<std::size_t>(e / 4)];
    total.elastic += s.elastic[e % 4];
    total.inelastic += s.inelastic[e % 4];
    if ((s.sound >> (e % 4) & 1u) == 0 && total.broken_element < 0) total.broken_element = e;
  }
  return total;
}

std::vector<double> InternalForce::enhanced_strains_at(std::span<const Vec3> u, double dt) const {
  const std::size_t stride = count_ * static_cast<std::size_t>(law_.layout.fields);
  std::vector<double> strains;
  std::vector<Pack4> history(stride), force(3 * count_);
  for (std::size_t b = 0; b < enhanced_.size(); ++b) {
    std::copy_n(history_.data() + b * stride, stride, history.data());
    Pack4 alpha = enhanced_[b];
    kernel_(metal_, law_, shapes_[b], {dt, true}, true, u.data(), &nodes_[b * 4 * count_], history.data(), &alpha,
            force.data());
    for (int i = 0; i < 4; ++i) strains.push_back(lane(alpha, i));
  }
  strains.resize(static_cast<std::size_t>(mesh_.element_count()));
  return strains;
}

void InternalForce::add_to(StateHash& hash) const {
  for (long e = 0; e < mesh_.element_count(); ++e)
    for (int q = 0; q < points(); ++q)
      for (int f = 0; f < law_.layout.fields; ++f) hash.add(history(e, q, f));
  if (enhanced_.empty()) return;
  for (long e = 0; e < mesh_.element_count(); ++e) hash.add(enhanced_strain(e));
}

void InternalForce::element_stiffness(std::span<const Vec3> u, long batch, std::array<ElementMatrix, 4>& out) {
  // Elastic strains of 1e-5: the second-order error of the difference and rounding are both near 1e-9 of the result.
  const double delta = 1e-5 * std::min({mesh_.edge.x, mesh_.edge.y, mesh_.edge.z}) / mesh_.order();
  const auto b = static_cast<std::size_t>(batch);
  std::vector<Vec3> local(4 * count_);
  std::vector<std::int32_t> own(4 * count_);
  for (std::size_t i = 0; i < own.size(); ++i) {
    local[i] = u[static_cast<std::size_t>(nodes_[b * 4 * count_ + i])];
    own[i] = static_cast<std::int32_t>(i);
  }
  const std::size_t dofs = 3 * count_;
  std::vector<Pack4> plus(dofs), minus(dofs);
  Pack4* const history = history_.data() + b * count_ * static_cast<std::size_t>(law_.layout.fields);
  auto force_at = [&](std::size_t node, double Vec3::*component, double shift, std::vector<Pack4>& f) {
    const auto saved = local;
    for (std::size_t i = 0; i < 4; ++i) local[4 * node + i].*component += shift;
    kernel_(metal_, law_, shapes_[b], {0.0, false}, false, local.data(), own.data(), history, alpha_of(b), f.data());
    local = saved;
  };
  double Vec3::*const components[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
  for (std::size_t node = 0; node < count_; ++node)
    for (std::size_t c = 0; c < 3; ++c) {
      force_at(node, components[c], delta, plus);
      force_at(node, components[c], -delta, minus);
      for (std::size_t row = 0; row < dofs; ++row) {
        const std::size_t entry = count_ * (row % 3) + row / 3;
        const Pack4 slope = (plus[entry] - minus[entry]) * Pack4(0.5 / delta);
        for (std::size_t i = 0; i < 4; ++i) out[i][dofs * row + 3 * node + c] = lane(slope, static_cast<int>(i));
      }
    }
  for (ElementMatrix& k : out)
    for (std::size_t i = 0; i < dofs; ++i)
      for (std::size_t j = 0; j < i; ++j) k[dofs * i + j] = k[dofs * j + i] = 0.5 * (k[dofs * i + j] + k[dofs * j + i]);
}

/// How much faster waves cross the deformed elements of a batch than those at rest, squared, at the worst point:
/// sum_d |F^-T g_d|^2 / sum_d |g_d|^2 with the parametric directions g_d = dxi_d / dX.
template <class Geometry>
double InternalForce::worst_shape(const Geometry& geometry, std::size_t batch, std::span<const Vec3> u) const {
  constexpr int N = Geometry::per_edge, count = Geometry::nodes;
  Pack4 nodal[3][count], gradient[3][3][count];
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& v = u[static_cast<std::size_t>(nodes_[(batch * count + a) * 4 + i])];
      set_lane(nodal[0][a], static_cast<int>(i), v.x), set_lane(nodal[1][a], static_cast<int>(i), v.y);
      set_lane(nodal[2][a], static_cast<int>(i), v.z);
    }
  if constexpr (N == 4)
    if (mesh_.bent()) turn(shapes_[batch].cosine, shapes_[batch].sine, nodal);
  for (int c = 0; c < 3; ++c) hex_gradient<N>(nodal[c], gradient[c][0], gradient[c][1], gradient[c][2]);
  Pack4 worst(1.0);
  for (int q = 0; q < count; ++q) {
    const Mat3<Pack4> f = deformation_gradient(geometry.reference_gradient(q, load_gradient(gradient, q)));
    const Mat3<Pack4> c = cofactor(f);
    const Pack4 j = rows(f, 0, c, 0);
    Pack4 sum(0.0);
    double rest = 0.0;
    for (int d = 0; d < 3; ++d) {
      const Vec3 g = geometry.direction(q, d);
      rest += squared_norm(g);
      for (int i = 0; i < 3; ++i) {
        const Pack4 along = c.m[i][0] * Pack4(g.x) + c.m[i][1] * Pack4(g.y) + c.m[i][2] * Pack4(g.z);
        sum += along * along;
      }
    }
    worst = larger(worst, sum / (j * j * Pack4(rest)));
  }
  return std::max({lane(worst, 0), lane(worst, 1), lane(worst, 2), lane(worst, 3)});
}

double InternalForce::shape_factor(std::span<const Vec3> u) const {
  std::vector<double> largest(sums_.size());
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t b = 0; b < largest.size(); ++b)
    largest[b] =
        mesh_.bent() ? worst_shape(*shapes_[b].curved, b, u) : with_nodes_per_edge(mesh_.per_edge(), [&](auto n) {
          return worst_shape(BoxGeometryOf<n()>::of_box(shapes_[b].box), b, u);
        });
  return std::sqrt(1.0 / *std::max_element(largest.begin(), largest.end()));
}

}  // namespace standoff::structure
