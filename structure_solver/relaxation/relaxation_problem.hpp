#pragma once
// What bringing a structure to rest needs to know of it. u and v are the free degrees of freedom only (clamped and
// symmetry components eliminated), in metres and metres per second; f is the internal force [N] on them (resisting, so
// M a = -f).
#include <Eigen/SparseCore>
#include <span>

namespace standoff::structure {

class RelaxationProblem {
 public:
  virtual ~RelaxationProblem() = default;
  virtual long dofs() const = 0;
  virtual std::span<const double> mass() const = 0;  // lumped, per dof, kg
  virtual void get_state(std::span<double> u, std::span<double> v) const = 0;
  /// Overwrites displacement and velocity; committed history stays.
  virtual void set_state(std::span<const double> u, std::span<const double> v) = 0;
  /// f(u) from the committed history, which is not written. dt > 0: time since the commit, for the rate in the flow
  /// stress; dt = 0: rate-independent flow at the committed temperature (static trial). False if an element inverts.
  virtual bool internal_force(std::span<const double> u, double dt, std::span<double> f) = 0;
  /// Makes the trial state at u the committed one (plastic strain, temperature, books).
  virtual void commit(std::span<const double> u, double dt) = 0;
  /// Elastic tangent at u with the plastic flow frozen, symmetric, free dofs only.
  virtual Eigen::SparseMatrix<double> stiffness(std::span<const double> u) = 0;
  virtual double plastic_work() const = 0;                                // J, committed
  virtual double elastic_energy(std::span<const double> u) = 0;           // J
  virtual double centre_deflection(std::span<const double> u) const = 0;  // m
  /// Books energy taken out by damping, so that the model's ledger still closes.
  virtual void book_damping(double joule) = 0;
};

}  // namespace standoff::structure
