#pragma once
// Sparse Cholesky (L D L^T, minimum-degree ordering) of a K + b M, K the tangent stiffness and M the lumped mass.
// Serves the first frequency (a = 1, b = 0), the preconditioner of the damped motion (a = gamma^2, b = 1 + gamma alpha)
// and of the static polish (a = 1, b = 0). The ordering is made once and kept while the pattern of K stays.
//
// K of a compressed or snapping structure can be indefinite. The signs of D tell (Sylvester's law of inertia: as many
// negative pivots as negative eigenvalues); then sigma M is added until all pivots are positive, and the caller says
// so. Memory: lower triangle of K and of L; 43 k degrees of freedom of a 20 x 20 quarter plate: about 13 M entries of
// L.
#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <span>

namespace standoff::structure {

class StiffnessFactor {
 public:
  using Matrix = Eigen::SparseMatrix<double>;
  using Vector = Eigen::VectorXd;

  StiffnessFactor(const Matrix& stiffness, std::span<const double> mass);

  /// New values of K; ordered again only if the pattern changed. The factor stays that of the old values until
  /// factor().
  void replace(const Matrix& stiffness);
  /// Factors stiffness_part K + mass_part M, adding the smallest of a rising series of shifts that makes it positive
  /// definite.
  void factor(double stiffness_part, double mass_part);
  /// x = (the factored matrix)^-1 b; x and b may be the same array.
  void solve(std::span<const double> b, std::span<double> x) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const { return cholesky_.solve(b); }
  /// y = K x
  void multiply(const Vector& x, Vector& y) const;

  long size() const { return lower_.rows(); }
  const Vector& mass() const { return mass_; }
  /// Negative pivots of the matrix asked for, before any shift.
  long negative_pivots() const { return negative_pivots_; }
  /// sigma [rad^2/s^2]: stiffness_part (K + sigma M) + mass_part M was factored.
  double shift() const { return shift_; }
  long factorisations() const { return factorisations_; }
  /// How many solves one factorisation costs, from the columns of L (measured on plates: a quarter of the mean fill a
  /// column, weighted by itself). A count, not a clock, so that decisions built on it repeat.
  double factorisation_in_solves() const;

 private:
  bool try_factor(double stiffness_part, double mass_part, long& negative);

  Matrix lower_;
  Vector mass_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> cholesky_;
  long negative_pivots_ = 0;
  double shift_ = 0.0;
  long factorisations_ = 0;
};

}  // namespace standoff::structure
