#include "structure_solver/models/plate_hex64/plate_relaxation.hpp"

#include <algorithm>
#include <memory>

namespace standoff::structure {
namespace {

constexpr double Vec3::*components[3] = {&Vec3::x, &Vec3::y, &Vec3::z};

std::size_t place(std::int32_t node, double Vec3::*component) {
  const std::size_t c = component == &Vec3::x ? 0 : component == &Vec3::y ? 1 : 2;
  return 3 * static_cast<std::size_t>(node) + c;
}

}  // namespace

PlateRelaxation::PlateRelaxation(PlateSolid& plate, const PlateProbes& probes) : plate_(plate), probes_(probes) {
  const NodalState& s = plate.state();
  sign_.assign(3 * s.u.size(), 1.0);
  std::vector<std::int32_t> lower(sign_.size(), -1);
  for (const Hinge& hinge : plate.mesh().hinges) {
    const std::size_t above = place(hinge.upper, hinge.component);
    sign_[above] = -1.0, lower[above] = static_cast<std::int32_t>(place(hinge.lower, hinge.component));
  }
  for (std::size_t i = 0; i < sign_.size(); ++i) {
    const bool free = s.inverse_mass[i / 3].*components[i % 3] != 0.0;
    const bool hung = lower[i] >= 0;  // nodes are numbered from the rear: the lower one is known by now
    dof_.push_back(!free  ? -1
                   : hung ? dof_[static_cast<std::size_t>(lower[i])]
                          : static_cast<std::int32_t>(mass_.size()));
    if (free && !hung) mass_.push_back(s.mass[i / 3]);
    if (free && hung) mass_[static_cast<std::size_t>(dof_.back())] += s.mass[i / 3];
  }
}

std::vector<Vec3> PlateRelaxation::spread(std::span<const double> free) const {
  std::vector<Vec3> full(dof_.size() / 3);
  for (std::size_t i = 0; i < dof_.size(); ++i)
    if (dof_[i] >= 0) full[i / 3].*components[i % 3] = sign_[i] * free[static_cast<std::size_t>(dof_[i])];
  return full;
}

void PlateRelaxation::get_state(std::span<double> u, std::span<double> v) const {
  const NodalState& s = plate_.state();
  for (std::size_t i = 0; i < dof_.size(); ++i) {
    if (dof_[i] < 0 || sign_[i] < 0.0) continue;
    u[static_cast<std::size_t>(dof_[i])] = s.u[i / 3].*components[i % 3];
    v[static_cast<std::size_t>(dof_[i])] = s.v[i / 3].*components[i % 3];
  }
}

void PlateRelaxation::set_state(std::span<const double> u, std::span<const double> v) {
  plate_.set_motion(spread(u), spread(v));
}

bool PlateRelaxation::internal_force(std::span<const double> u, double dt, std::span<double> f) {
  const ForceSums sums = plate_.forces().evaluate(spread(u), {dt, true}, false);
  if (sums.broken_element >= 0) return false;
  const InternalForce& forces = plate_.forces();
#pragma omp parallel for schedule(static) num_threads(plate_.threads())
  for (std::size_t i = 0; i < dof_.size() / 3; ++i) {
    const Vec3 force = forces.at_node(i);
    for (std::size_t c = 0; c < 3; ++c)
      if (dof_[3 * i + c] >= 0 && sign_[3 * i + c] > 0.0)
        f[static_cast<std::size_t>(dof_[3 * i + c])] = force.*components[c];
  }
  for (const Hinge& hinge : plate_.mesh().hinges)
    f[static_cast<std::size_t>(dof_[place(hinge.upper, hinge.component)])] -=
        forces.at_node(static_cast<std::size_t>(hinge.upper)).*hinge.component;
  return true;
}

void PlateRelaxation::commit(std::span<const double> u, double dt) {
  plate_.commit(spread(u), dt);
}

double PlateRelaxation::elastic_energy(std::span<const double> u) {
  return plate_.forces().evaluate(spread(u), {0.0, false}, false).elastic;
}

double PlateRelaxation::centre_deflection(std::span<const double> u) const {
  return probes_.centre_deflection(spread(u));
}

/// For every node the degrees of freedom of all nodes that share an element with it, sorted.
std::vector<std::vector<std::int32_t>> PlateRelaxation::columns_of_nodes() const {
  const PlateMesh& mesh = plate_.mesh();
  std::vector<std::vector<std::int32_t>> columns(mesh.node_count());
  for (long e = 0; e < mesh.element_count(); ++e)
    for (int a = 0; a < mesh.element_nodes(); ++a) {
      auto& column = columns[static_cast<std::size_t>(mesh.element_node(e, a))];
      for (int b = 0; b < mesh.element_nodes(); ++b) column.push_back(mesh.element_node(e, b));
    }
  for (auto& column : columns) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    std::vector<std::int32_t> rows;
    for (const std::int32_t node : column)
      for (std::size_t c = 0; c < 3; ++c)
        if (const std::int32_t row = dof_[3 * static_cast<std::size_t>(node) + c]; row >= 0) rows.push_back(row);
    column = std::move(rows);
  }
  return columns;
}

/// The pattern. The degree of freedom of a hinge has the neighbours of both its nodes.
Eigen::SparseMatrix<double> PlateRelaxation::empty_stiffness() const {
  const std::vector<std::vector<std::int32_t>> columns = columns_of_nodes();
  std::vector<std::int32_t> other(mass_.size(), -1);
  for (const Hinge& hinge : plate_.mesh().hinges)
    other[static_cast<std::size_t>(dof_[place(hinge.upper, hinge.component)])] = hinge.upper;
  Eigen::SparseMatrix<double> k(dofs(), dofs());
  std::size_t entries = 0;
  for (std::size_t i = 0; i < dof_.size(); ++i)
    if (dof_[i] >= 0) entries += columns[i / 3].size();
  k.reserve(static_cast<Eigen::Index>(entries));
  std::vector<std::int32_t> rows;
  for (std::size_t i = 0; i < dof_.size(); ++i) {
    if (dof_[i] < 0 || sign_[i] < 0.0) continue;
    rows = columns[i / 3];
    if (const std::int32_t node = other[static_cast<std::size_t>(dof_[i])]; node >= 0) {
      const auto& more = columns[static_cast<std::size_t>(node)];
      rows.insert(rows.end(), more.begin(), more.end());
    }
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    k.startVec(dof_[i]);
    for (const std::int32_t row : rows) k.insertBackByOuterInner(dof_[i], row) = 0.0;
  }
  k.finalize();
  return k;
}

Eigen::SparseMatrix<double> PlateRelaxation::stiffness(std::span<const double> u) {
  const PlateMesh& mesh = plate_.mesh();
  Eigen::SparseMatrix<double> k = empty_stiffness();
  const std::vector<Vec3> full = spread(u);
  const auto nodes = static_cast<std::size_t>(mesh.element_nodes()), element_dofs = 3 * nodes;
  auto element = std::make_unique<std::array<InternalForce::ElementMatrix, 4>>();
  for (long batch = 0; batch < plate_.forces().batches(); ++batch) {
    plate_.forces().element_stiffness(full, batch, *element);
    for (long e = 4 * batch; e < std::min(4 * batch + 4, mesh.element_count()); ++e) {
      std::array<std::int32_t, 192> dof;
      std::array<double, 192> sign;
      for (std::size_t a = 0; a < nodes; ++a)
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t i = 3 * static_cast<std::size_t>(mesh.element_node(e, static_cast<int>(a))) + c;
          dof[3 * a + c] = dof_[i], sign[3 * a + c] = sign_[i];
        }
      const auto& matrix = (*element)[static_cast<std::size_t>(e - 4 * batch)];
      for (std::size_t j = 0; j < element_dofs; ++j) {
        if (dof[j] < 0) continue;
        for (std::size_t i = 0; i < element_dofs; ++i)
          if (dof[i] >= 0) k.coeffRef(dof[i], dof[j]) += sign[i] * sign[j] * matrix[element_dofs * i + j];
      }
    }
  }
  return k;
}

}  // namespace standoff::structure
