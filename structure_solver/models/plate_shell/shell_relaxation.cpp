#include "structure_solver/models/plate_shell/shell_relaxation.hpp"

namespace standoff::structure {
namespace {

constexpr double Vec3::*components[3] = {&Vec3::x, &Vec3::y, &Vec3::z};

/// Component c of 0 .. 4 of a node: of its displacement, then of its slip.
template <class Vector>
auto& component(Vector& displacement, Vector& slip, std::size_t node, std::size_t c) {
  return c < 3 ? displacement[node].*components[c] : slip[node].*components[c - 3];
}

}  // namespace

ShellRelaxation::ShellRelaxation(ShellPlate& plate, const ShellProbes& probes) : plate_(plate), probes_(probes) {
  const NodalState &u = plate.translation(), &slip = plate.slip();
  for (std::size_t i = 0; i < 5 * u.u.size(); ++i) {
    const bool free = component(u.inverse_mass, slip.inverse_mass, i / 5, i % 5) != 0.0;
    dof_.push_back(free ? static_cast<std::int32_t>(mass_.size()) : -1);
    if (free) mass_.push_back((i % 5 < 3 ? u : slip).mass[i / 5]);
  }
}

ShellPlate::Nodal ShellRelaxation::spread(std::span<const double> free) const {
  ShellPlate::Nodal full{std::vector<Vec3>(dof_.size() / 5), std::vector<Vec3>(dof_.size() / 5)};
  for (std::size_t i = 0; i < dof_.size(); ++i)
    if (dof_[i] >= 0) component(full.u, full.slip, i / 5, i % 5) = free[static_cast<std::size_t>(dof_[i])];
  return full;
}

void ShellRelaxation::get_state(std::span<double> u, std::span<double> v) const {
  const NodalState &moved = plate_.translation(), &slip = plate_.slip();
  for (std::size_t i = 0; i < dof_.size(); ++i) {
    if (dof_[i] < 0) continue;
    u[static_cast<std::size_t>(dof_[i])] = component(moved.u, slip.u, i / 5, i % 5);
    v[static_cast<std::size_t>(dof_[i])] = component(moved.v, slip.v, i / 5, i % 5);
  }
}

void ShellRelaxation::set_state(std::span<const double> u, std::span<const double> v) {
  plate_.set_motion(spread(u), spread(v));
}

bool ShellRelaxation::internal_force(std::span<const double> u, double dt, std::span<double> f) {
  const ShellPlate::Nodal at = spread(u);
  ShellForce& forces = plate_.forces();
  if (forces.evaluate(at.u, at.slip, {dt, true}, false).broken_element >= 0) return false;
  for (std::size_t node = 0; node < at.u.size(); ++node) {
    const Vec3 force[2] = {forces.on_displacement(node), forces.on_slip(node)};
    for (std::size_t c = 0; c < 5; ++c)
      if (const std::int32_t dof = dof_[5 * node + c]; dof >= 0)
        f[static_cast<std::size_t>(dof)] = force[c / 3].*components[c % 3];
  }
  return true;
}

double ShellRelaxation::elastic_energy(std::span<const double> u) {
  const ShellPlate::Nodal at = spread(u);
  return plate_.forces().evaluate(at.u, at.slip, {0.0, false}, false).elastic;
}

double ShellRelaxation::centre_deflection(std::span<const double> u) const {
  return probes_.centre_deflection(spread(u).u);
}

Eigen::SparseMatrix<double> ShellRelaxation::stiffness(std::span<const double> u) {
  const ShellPlate::Nodal at = spread(u);
  const ShellMesh& mesh = plate_.mesh();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(400 * mesh.quads.size());
  for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
    const ShellForce::ElementMatrix k = plate_.forces().element_stiffness(e, at.u, at.slip);
    std::array<std::int32_t, 20> dof;
    for (std::size_t i = 0; i < 20; ++i) dof[i] = dof_[5 * static_cast<std::size_t>(mesh.quads[e][i / 5]) + i % 5];
    for (std::size_t i = 0; i < 20; ++i)
      for (std::size_t j = 0; j < 20; ++j)
        if (dof[i] >= 0 && dof[j] >= 0) entries.emplace_back(dof[i], dof[j], k[20 * i + j]);
  }
  Eigen::SparseMatrix<double> matrix(dofs(), dofs());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace standoff::structure
