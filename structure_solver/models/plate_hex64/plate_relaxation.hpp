#pragma once
// The plate as relaxation sees it: free degrees of freedom only, trial forces that leave the history alone.
#include "structure_solver/models/plate_hex64/plate_probes.hpp"
#include "structure_solver/relaxation/relaxation_problem.hpp"

namespace standoff::structure {

class PlateRelaxation final : public RelaxationProblem {
 public:
  PlateRelaxation(PlateSolid& plate, const PlateProbes& probes);
  long dofs() const override { return static_cast<long>(mass_.size()); }
  std::span<const double> mass() const override { return mass_; }
  void get_state(std::span<double> u, std::span<double> v) const override;
  void set_state(std::span<const double> u, std::span<const double> v) override;
  bool internal_force(std::span<const double> u, double dt, std::span<double> f) override;
  void commit(std::span<const double> u, double dt) override;
  Eigen::SparseMatrix<double> stiffness(std::span<const double> u) override;
  double plastic_work() const override { return plate_.books().inelastic_work; }
  double elastic_energy(std::span<const double> u) override;
  double centre_deflection(std::span<const double> u) const override;
  void book_damping(double joule) override { plate_.books().damping += joule; }

 private:
  /// Free components spread over all nodes, zero where fixed.
  std::vector<Vec3> spread(std::span<const double> free) const;
  std::vector<std::vector<std::int32_t>> columns_of_nodes() const;
  Eigen::SparseMatrix<double> empty_stiffness() const;

  PlateSolid& plate_;
  const PlateProbes& probes_;
  std::vector<double> mass_;
  std::vector<std::int32_t> dof_;  // [3 node + component], -1 where fixed
  std::vector<double> sign_;       // [3 node + component], -1 for the upper node of a hinge, which has the lower one's
};

}  // namespace standoff::structure
