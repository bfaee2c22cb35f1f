#include "structure_solver/models/plate_hex64/plate_relaxation.hpp"

#include <algorithm>
#include <memory>

namespace standoff::structure {
namespace {

constexpr double Vec3::*components[3] = {&Vec3::x, &Vec3::y, &Vec3::z};

}  // namespace

PlateRelaxation::PlateRelaxation(PlateSolid& plate, const PlateProbes& probes) : plate_(plate), probes_(probes) {
  const NodalState& s = plate.state();
  for (std::size_t i = 0; i < s.u.size(); ++i)
    for (const auto c : components) {
      const bool free = s.inverse_mass[i].*c != 0.0;
      dof_.push_back(free ? static_cast<std::int32_t>(mass_.size()) : -1);
      if (free) mass_.push_back(s.mass[i]);
    }
}

std::vector<Vec3> PlateRelaxation::spread(std::span<const double> free) const {
  std::vector<Vec3> full(dof_.size() / 3);
  for (std::size_t i = 0; i < dof_.size(); ++i)
    if (dof_[i] >= 0) full[i / 3].*components[i % 3] = free[static_cast<std::size_t>(dof_[i])];
  return full;
}

void PlateRelaxation::get_state(std::span<double> u, std::span<double> v) const {
  const NodalState& s = plate_.state();
  for (std::size_t i = 0; i < dof_.size(); ++i) {
    if (dof_[i] < 0) continue;
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
      if (dof_[3 * i + c] >= 0) f[static_cast<std::size_t>(dof_[3 * i + c])] = force.*components[c];
  }
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

/// The pattern: a column of every degree of freedom holds those of all nodes that share an element with its node.
Eigen::SparseMatrix<double> PlateRelaxation::empty_stiffness() const {
  const PlateMesh& mesh = plate_.mesh();
  std::vector<std::vector<std::int32_t>> neighbours(mesh.node_count());
  for (long e = 0; e < mesh.element_count(); ++e)
    for (int a = 0; a < hex_nodes; ++a)
      for (int b = 0; b < hex_nodes; ++b)
        neighbours[static_cast<std::size_t>(mesh.element_node(e, a))].push_back(mesh.element_node(e, b));
  std::vector<int> sizes(mass_.size(), 0);
  auto for_free = [&](std::size_t node, auto&& body) {
    for (std::size_t c = 0; c < 3; ++c)
      if (dof_[3 * node + c] >= 0) body(dof_[3 * node + c]);
  };
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    auto& list = neighbours[i];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    int size = 0;
    for (const std::int32_t j : list) for_free(static_cast<std::size_t>(j), [&](std::int32_t) { ++size; });
    for_free(i, [&](std::int32_t column) { sizes[static_cast<std::size_t>(column)] = size; });
  }
  Eigen::SparseMatrix<double> k(dofs(), dofs());
  k.reserve(sizes);
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    for_free(i, [&](std::int32_t column) {
      for (const std::int32_t j : neighbours[i])
        for_free(static_cast<std::size_t>(j), [&](std::int32_t row) { k.insert(row, column) = 0.0; });
    });
  k.makeCompressed();
  return k;
}

Eigen::SparseMatrix<double> PlateRelaxation::stiffness(std::span<const double> u) {
  const PlateMesh& mesh = plate_.mesh();
  Eigen::SparseMatrix<double> k = empty_stiffness();
  const std::vector<Vec3> full = spread(u);
  auto element = std::make_unique<std::array<InternalForce::ElementMatrix, 4>>();
  for (long batch = 0; batch < plate_.forces().batches(); ++batch) {
    plate_.forces().element_stiffness(full, batch, *element);
    for (long e = 4 * batch; e < std::min(4 * batch + 4, mesh.element_count()); ++e) {
      std::array<std::int32_t, 192> dof;
      for (std::size_t a = 0; a < 64; ++a)
        for (std::size_t c = 0; c < 3; ++c)
          dof[3 * a + c] = dof_[3 * static_cast<std::size_t>(mesh.element_node(e, static_cast<int>(a))) + c];
      const auto& matrix = (*element)[static_cast<std::size_t>(e - 4 * batch)];
      for (std::size_t j = 0; j < 192; ++j) {
        if (dof[j] < 0) continue;
        for (std::size_t i = 0; i < 192; ++i)
          if (dof[i] >= 0) k.coeffRef(dof[i], dof[j]) += matrix[192 * i + j];
      }
    }
  }
  return k;
}

}  // namespace standoff::structure
