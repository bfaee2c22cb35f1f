#pragma once
// First frequency and fastest mode of a model at rest, by iteration with its own stiffness and mass.
#include <Eigen/SparseCholesky>
#include <cmath>

#include <gtest/gtest.h>

#include "structure_solver/models/structural_model.hpp"
#include "structure_solver/relaxation/relaxation_problem.hpp"

namespace standoff::structure::testing {

/// Hz; the Rayleigh quotient, from above.
inline double first_frequency(StructuralModel& model) {
  RelaxationProblem& plate = *model.relaxation();
  const std::vector<double> rest(static_cast<std::size_t>(plate.dofs()), 0.0);
  const Eigen::SparseMatrix<double> k = plate.stiffness(rest);
  const Eigen::Map<const Eigen::VectorXd> mass(plate.mass().data(), plate.dofs());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor(k);
  EXPECT_EQ(factor.info(), Eigen::Success);
  Eigen::VectorXd x(plate.dofs());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 1.0 + 0.1 * std::sin(static_cast<double>(i));
  double quotient = 0.0;
  for (int i = 0; i < 12; ++i) {
    x = factor.solve(mass.cwiseProduct(x)).eval();
    quotient = x.dot(k * x) / x.dot(mass.cwiseProduct(x));
    x.normalize();
  }
  return std::sqrt(quotient) / (2.0 * M_PI);
}

struct FastestMode {
  Eigen::VectorXd shape;                                  // largest entry 1
  double omega = 0.0;                                     // 1/s
  double stability_limit() const { return 2.0 / omega; }  // s, of central differences
};

/// By power iteration, omega from below: 600 iterations are 1e-3 short at most.
inline FastestMode fastest_mode(StructuralModel& model, int iterations = 600) {
  RelaxationProblem& plate = *model.relaxation();
  const Eigen::SparseMatrix<double> k =
      plate.stiffness(std::vector<double>(static_cast<std::size_t>(plate.dofs()), 0.0));
  const Eigen::Map<const Eigen::VectorXd> mass(plate.mass().data(), plate.dofs());
  Eigen::VectorXd x(plate.dofs());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = std::sin(1.0 + 12.9 * static_cast<double>(i));
  double largest = 0.0;
  for (int i = 0; i < iterations; ++i) {
    x = (k * x).cwiseQuotient(mass).eval();
    largest = x.norm();
    x /= largest;
  }
  return {x / x.cwiseAbs().maxCoeff(), std::sqrt(largest)};
}

/// lambda of omega = lambda sqrt(D / (rho h)) / a^2 for the plate of the case.
inline double frequency_factor(double hertz, const PlateSpec& plate) {
  const MaterialSpec& m = plate.material;
  const double h = plate.size.z, nu = m.poissons_ratio;
  const double stiffness = m.youngs_modulus * h * h * h / (12.0 * (1.0 - nu * nu));
  return 2.0 * M_PI * hertz * plate.size.x * plate.size.x / std::sqrt(stiffness / (m.density * h));
}

}  // namespace standoff::structure::testing
