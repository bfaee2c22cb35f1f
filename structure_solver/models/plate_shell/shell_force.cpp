#include "structure_solver/models/plate_shell/shell_force.hpp"

#include <algorithm>
#include <cmath>

#include "structure_solver/models/plate_shell/director.hpp"

namespace standoff::structure {
namespace {

double virgin_flow(const MetalParameters& metal, Hardening hardening) {
  if (hardening != Hardening::power) return metal.flow.A;
  return static_flow<Hardening::power, false>(metal.flow, 0.0, metal.flow.room_temperature).stress;
}

}  // namespace

ShellForce::ShellForce(const ShellMesh& mesh, const MetalParameters& metal, const MetalEffects& effects, int threads)
    : mesh_(mesh), metal_(metal), kernel_(choose_shell_kernel(effects)), threads_(threads) {
  const std::size_t count = mesh.quads.size();
  sums_.resize(count), buffer_.resize(8 * count);
  node_begin_.assign(mesh.node_count() + 1, 0);
  for (std::size_t e = 0; e < count; ++e) {
    geometry_.push_back(ShellGeometry::of_nodes(mesh.corners(e)));
    for (const std::int32_t node : mesh.quads[e]) ++node_begin_[static_cast<std::size_t>(node) + 1];
  }
  for (std::size_t i = 0; i < mesh.node_count(); ++i) node_begin_[i + 1] += node_begin_[i];
  node_entry_.resize(static_cast<std::size_t>(node_begin_.back()));
  std::vector<std::int32_t> next(node_begin_.begin(), node_begin_.end() - 1);
  for (std::size_t e = 0; e < count; ++e)
    for (std::size_t a = 0; a < 4; ++a)
      node_entry_[static_cast<std::size_t>(next[static_cast<std::size_t>(mesh.quads[e][a])]++)] =
          static_cast<std::int32_t>(8 * e + a);

  const HistoryLayout& layout = kernel_.layout;
  const auto row_size = static_cast<std::size_t>(layout.fields) + 1;
  history_.assign(count * element_fields(), Pack4(0.0));
  const double static_stress = virgin_flow(metal, effects.hardening);
  for (std::size_t row = 0; row < history_.size(); row += row_size) {
    if (layout.temperature >= 0)
      history_[row + static_cast<std::size_t>(layout.temperature)] = metal.flow.room_temperature;
    if (layout.static_stress >= 0) history_[row + static_cast<std::size_t>(layout.static_stress)] = static_stress;
  }
}

ShellForce::Corners ShellForce::corners(std::size_t element, std::span<const Vec3> u,
                                        std::span<const Vec3> slip) const {
  Corners at;
  for (std::size_t a = 0; a < 4; ++a) {
    const auto node = static_cast<std::size_t>(mesh_.quads[element][a]);
    at.u[a] = u[node], at.slip[a] = slip[node];
  }
  return at;
}

ShellMotion ShellForce::motion_of(const Corners& at) const {
  ShellMotion m{at.u, {}};
  for (std::size_t a = 0; a < 4; ++a) m.lean[a] = director_lean(at.slip[a], 0.5 * mesh_.options.size.z);
  return m;
}

ShellSums ShellForce::element_force(std::size_t element, const Corners& at, const PointStep& step, bool commit,
                                    Vec3* out) {
  const double thickness = mesh_.options.size.z;
  ShellForces f;
  const ShellSums sums = kernel_.force(metal_, geometry_[element], thickness, step, commit, motion_of(at),
                                       &history_[element * element_fields()], f);
  for (std::size_t a = 0; a < 4; ++a) {
    out[a] = f.force[a];
    out[4 + a] = slip_force(at.slip[a], f.couple[a], 0.5 * thickness);
  }
  return sums;
}

ForceSums ShellForce::evaluate(std::span<const Vec3> u, std::span<const Vec3> slip, const PointStep& step,
                               bool commit) {
  const std::size_t count = mesh_.quads.size();
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t e = 0; e < count; ++e)
    sums_[e] = element_force(e, corners(e, u, slip), step, commit, &buffer_[8 * e]);
  ForceSums total;
  for (std::size_t e = 0; e < count; ++e) {
    total.elastic += sums_[e].elastic, total.inelastic += sums_[e].inelastic;
    if (!sums_[e].sound && total.broken_element < 0) total.broken_element = static_cast<long>(e);
  }
  return total;
}

std::array<Pack4, shell_layers> ShellForce::stress(std::size_t element, std::span<const Vec3> u,
                                                   std::span<const Vec3> slip) const {
  return kernel_.stress(metal_, geometry_[element], mesh_.options.size.z, motion_of(corners(element, u, slip)),
                        &history_[element * element_fields()]);
}

Vec3 ShellForce::gauss_position(std::size_t element, int point) const {
  constexpr double near = 0.5 * (1.0 + 0.57735026918962576), far = 1.0 - near;
  const std::array<Vec3, 4> at = mesh_.corners(element);
  Vec3 sum;
  for (int a = 0; a < 4; ++a)
    sum += (a == point ? near * near : (a + point) % 2 == 0 ? far * far : near * far) * at[static_cast<std::size_t>(a)];
  return sum;
}

ShellForce::ElementMatrix ShellForce::element_stiffness(std::size_t element, std::span<const Vec3> u,
                                                        std::span<const Vec3> slip) {
  static constexpr double Vec3::*components[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
  // Strains of 1e-5: the second-order error of the difference and the normal stress that is left (1e-11 in strain) are
  // both below 1e-6 of the result.
  const std::array<Vec3, 4> rest = mesh_.corners(element);
  const double edge = std::sqrt(squared_norm(rest[2] - rest[0]));
  const Corners at = corners(element, u, slip);
  ElementMatrix k{};
  for (std::size_t column = 0; column < 20; ++column) {
    const std::size_t node = column / 5, c = column % 5;
    const double delta = 1e-5 * (c < 3 ? edge : mesh_.options.size.z);
    std::array<Vec3, 8> plus, minus;
    for (const double side : {1.0, -1.0}) {
      Corners moved = at;
      (c < 3 ? moved.u : moved.slip)[node].*components[c % 3] += side * delta;
      element_force(element, moved, {0.0, false}, false, side > 0.0 ? plus.data() : minus.data());
    }
    for (std::size_t row = 0; row < 20; ++row) {
      const std::size_t place = row % 5 < 3 ? row / 5 : 4 + row / 5;
      const auto component = components[row % 5 % 3];
      k[20 * row + column] = 0.5 / delta * (plus[place].*component - minus[place].*component);
    }
  }
  for (std::size_t i = 0; i < 20; ++i)
    for (std::size_t j = 0; j < i; ++j) k[20 * i + j] = k[20 * j + i] = 0.5 * (k[20 * i + j] + k[20 * j + i]);
  return k;
}

double ShellForce::shape_factor(std::span<const Vec3> u, std::span<const Vec3> slip) const {
  std::vector<double> least(mesh_.quads.size());
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t e = 0; e < least.size(); ++e) {
    const ShellSlopes slopes(geometry_[e], motion_of(corners(e, u, slip)));
    Pack4 square(1.0);
    for (int l = 0; l < shell_layers; ++l) {
      const Lamina<Pack4> c = slopes.strain(slopes.lamina(0.5 * mesh_.options.size.z * layer_place[l]));
      const Pack4 half = Pack4(0.5) * (c.xx - c.yy), mean = Pack4(1.0) + Pack4(0.5) * (c.xx + c.yy);
      square = smaller(square, mean - square_root(fused(half, half, c.xy * c.xy)));  // least stretch in the lamina
      const Pack4 thick =
          Pack4(1.0) + history_[e * element_fields() +
                                static_cast<std::size_t>(l * (kernel_.layout.fields + 1) + kernel_.layout.fields)];
      square = smaller(square, thick * thick);
    }
    least[e] = std::min({lane(square, 0), lane(square, 1), lane(square, 2), lane(square, 3)});
  }
  return std::sqrt(std::max(1e-4, *std::min_element(least.begin(), least.end())));
}

void ShellForce::add_to(StateHash& hash) const {
  for (const Pack4& row : history_)
    for (int q = 0; q < 4; ++q) hash.add(lane(row, q));
}

}  // namespace standoff::structure
