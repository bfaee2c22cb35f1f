#include "structure_solver/relaxation/stiffness_factor.hpp"

#include <algorithm>

#include "coupling/base/stop.hpp"

namespace standoff::structure {
namespace {

/// Lower triangle with every diagonal entry present, so that M can be added in place.
StiffnessFactor::Matrix lower_triangle(const StiffnessFactor::Matrix& stiffness) {
  StiffnessFactor::Matrix diagonal(stiffness.rows(), stiffness.cols());
  diagonal.setIdentity();
  StiffnessFactor::Matrix lower = stiffness.triangularView<Eigen::Lower>();
  lower += 0.0 * diagonal;
  lower.makeCompressed();
  return lower;
}

bool same_pattern(const StiffnessFactor::Matrix& a, const StiffnessFactor::Matrix& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr());
}

}  // namespace

StiffnessFactor::StiffnessFactor(const Matrix& stiffness, std::span<const double> mass)
    : lower_(lower_triangle(stiffness)),
      mass_(Eigen::Map<const Vector>(mass.data(), static_cast<Eigen::Index>(mass.size()))) {
  if (stiffness.rows() != mass_.size() || stiffness.cols() != mass_.size())
    throw Stop(ExitCode::guard, "relaxation: the stiffness has " + std::to_string(stiffness.rows()) +
                                    " rows, the mass " + std::to_string(mass_.size()) +
                                    "; the model must give both for the free degrees of freedom");
  cholesky_.analyzePattern(lower_);
}

void StiffnessFactor::replace(const Matrix& stiffness) {
  Matrix lower = lower_triangle(stiffness);
  const bool same = same_pattern(lower, lower_);
  lower_ = std::move(lower);
  if (!same) cholesky_.analyzePattern(lower_);
}

void StiffnessFactor::factor(double stiffness_part, double mass_part) {
  shift_ = 0.0;
  const bool done = try_factor(stiffness_part, mass_part, negative_pivots_);
  if (done && negative_pivots_ == 0) return;
  // Start far below any frequency of interest (1e-9 of the largest squared frequency), rise until the inertia is right.
  const double largest = (lower_.diagonal().array().abs() / mass_.array()).maxCoeff();
  long negative = 1;
  for (shift_ = 1e-9 * largest; shift_ < 100.0 * largest; shift_ *= 8.0)
    if (try_factor(stiffness_part, mass_part + stiffness_part * shift_, negative) && negative == 0) return;
  throw Stop(
      ExitCode::guard,
      "relaxation: the stiffness cannot be factored even with a shift of 100 times the largest squared frequency; "
      "it must hold a wrong number (not finite, or not symmetric)");
}

bool StiffnessFactor::try_factor(double stiffness_part, double mass_part, long& negative) {
  Matrix matrix = lower_;
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (Matrix::InnerIterator entry(matrix, column); entry; ++entry)
      entry.valueRef() = stiffness_part * entry.value() + (entry.row() == column ? mass_part * mass_[column] : 0.0);
  cholesky_.factorize(matrix);
  ++factorisations_;
  if (cholesky_.info() != Eigen::Success || !cholesky_.vectorD().allFinite()) {
    negative = 1;  // a zero pivot: singular, treated like an indefinite matrix
    return false;
  }
  negative = (cholesky_.vectorD().array() <= 0.0).count();
  return true;
}

void StiffnessFactor::solve(std::span<const double> b, std::span<double> x) const {
  const Eigen::Map<const Vector> right(b.data(), static_cast<Eigen::Index>(b.size()));
  const Vector solution = cholesky_.solve(right);
  std::copy(solution.begin(), solution.end(), x.begin());
}

double StiffnessFactor::factorisation_in_solves() const {
  const Matrix& factor = cholesky_.matrixL().nestedExpression();
  double entries = 0.0, squares = 0.0;
  for (Eigen::Index column = 0; column < factor.outerSize(); ++column) {
    const double fill = factor.outerIndexPtr()[column + 1] - factor.outerIndexPtr()[column] + 1;
    entries += fill, squares += fill * fill;
  }
  return 0.25 * squares / entries;
}

void StiffnessFactor::multiply(const Vector& x, Vector& y) const {
  y.noalias() = lower_.selfadjointView<Eigen::Lower>() * x;
}

}  // namespace standoff::structure
