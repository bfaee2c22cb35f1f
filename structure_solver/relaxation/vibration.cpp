#include "structure_solver/relaxation/vibration.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "coupling/base/stop.hpp"

namespace standoff::structure {
namespace {

/// Starting vectors without order or symmetry, the same in every run: fractional parts of multiples of irrational
/// numbers.
Eigen::MatrixXd starting_block(long size, long columns, std::span<const double> guess) {
  Eigen::MatrixXd block(size, columns);
  for (long column = 0; column < columns; ++column)
    for (long row = 0; row < size; ++row) {
      const double product =
          static_cast<double>(row + 1) * std::sqrt(2.0 + static_cast<double>(column * column + column));
      block(row, column) = product - std::floor(product) - 0.5;
    }
  const Eigen::Map<const Eigen::VectorXd> first(guess.data(), static_cast<Eigen::Index>(guess.size()));
  if (first.size() == size && first.allFinite() && first.norm() > 0.0)
    block.col(0) += first * (10.0 * block.col(0).norm() / first.norm());
  return block;
}

/// Index of the eigenvalue that counts, or -1.
long smallest_positive(const Eigen::VectorXd& ascending, double noise) {
  for (long i = 0; i < ascending.size(); ++i)
    if (ascending[i] > noise) return i;
  return -1;
}

}  // namespace

LowestMode lowest_mode(StiffnessFactor& factor, std::span<const double> guess) {
  LowestMode mode;
  factor.factor(1.0, 0.0);
  mode.negative_modes = factor.shift() > 0.0 ? factor.negative_pivots() : 0;
  mode.shift = factor.shift();
  const long columns = std::min(factor.size(), 5 + std::min(mode.negative_modes, 20L));
  Eigen::MatrixXd block = starting_block(factor.size(), columns, guess);
  double previous = 0.0;
  for (mode.iterations = 1; mode.iterations <= 100; ++mode.iterations) {
    const Eigen::MatrixXd loads = factor.mass().asDiagonal() * block;
    block = factor.solve(loads);
    const Eigen::MatrixXd stiffness = block.transpose() * loads;  // of K + shift M
    const Eigen::MatrixXd inertia = block.transpose() * factor.mass().asDiagonal() * block;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(0.5 * (stiffness + stiffness.transpose()),
                                                                         0.5 * (inertia + inertia.transpose()));
    if (ritz.info() != Eigen::Success)
      throw Stop(ExitCode::guard, "relaxation: the first frequency could not be found (mass or stiffness not finite)");
    block = (block * ritz.eigenvectors()).eval();
    const Eigen::VectorXd values = ritz.eigenvalues().array() - mode.shift;
    const long chosen = smallest_positive(values, 1e-6 * mode.shift);
    const double now = chosen >= 0 ? values[chosen] : std::abs(values[values.size() - 1]);
    mode.angular_frequency = std::sqrt(now);
    if (mode.iterations > 2 && std::abs(now - previous) <= 1e-5 * now) break;
    previous = now;
  }
  if (!(mode.angular_frequency > 0.0) || !std::isfinite(mode.angular_frequency))
    throw Stop(ExitCode::guard,
               "relaxation: the structure has no restoring stiffness, so it cannot come to rest; is it held?");
  return mode;
}

double highest_frequency(const StiffnessFactor& factor) {
  Eigen::VectorXd x = starting_block(factor.size(), 1, {}).col(0), y(factor.size());
  double value = 0.0;
  for (int iteration = 0; iteration < 300; ++iteration) {
    factor.multiply(x, y);
    y.array() /= factor.mass().array();
    const double before = value;
    value = y.norm() / x.norm();
    x = y / y.norm();
    if (iteration > 20 && std::abs(value - before) <= 1e-4 * value) break;
  }
  return 1.05 * std::sqrt(value);
}

}  // namespace standoff::structure
