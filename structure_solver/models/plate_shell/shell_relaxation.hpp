#pragma once
// The shell plate as relaxation sees it: free displacements and slips, all in metres, and trial forces that leave the
// history alone.
#include "structure_solver/models/plate_shell/shell_plate.hpp"
#include "structure_solver/models/plate_shell/shell_probes.hpp"
#include "structure_solver/relaxation/relaxation_problem.hpp"

namespace standoff::structure {

class ShellRelaxation final : public RelaxationProblem {
 public:
  ShellRelaxation(ShellPlate& plate, const ShellProbes& probes);
  long dofs() const override { return static_cast<long>(mass_.size()); }
  std::span<const double> mass() const override { return mass_; }
  void get_state(std::span<double> u, std::span<double> v) const override;
  void set_state(std::span<const double> u, std::span<const double> v) override;
  bool internal_force(std::span<const double> u, double dt, std::span<double> f) override;
  void commit(std::span<const double> u, double dt) override { plate_.commit(spread(u), dt); }
  Eigen::SparseMatrix<double> stiffness(std::span<const double> u) override;
  double plastic_work() const override { return plate_.books().inelastic_work; }
  double elastic_energy(std::span<const double> u) override;
  double centre_deflection(std::span<const double> u) const override;
  void book_damping(double joule) override { plate_.books().damping += joule; }

 private:
  /// Free components spread over all nodes, zero where fixed.
  ShellPlate::Nodal spread(std::span<const double> free) const;

  ShellPlate& plate_;
  const ShellProbes& probes_;
  std::vector<double> mass_;
  std::vector<std::int32_t> dof_;  // [5 node + component], displacement x y z, slip x y; -1 where fixed
};

}  // namespace standoff::structure
