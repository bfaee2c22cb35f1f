// The clamped elastic plate under uniform pressure against published solutions, by Newton's method with the model's own
// forces and stiffness. D = E h^3 / 12 (1 - nu^2).
//   small  w = 0.00126532 q a^4 / D (Timoshenko & Woinowsky-Krieger, Theory of Plates and Shells, table 35: 0.00126).
//          Cubic elements converge from below, 0.5 % at 10 x 10; shear adds less than 0.1 %: 1 % asked
//   large  clamped, immovable, nu = 0.316 (Levy, Square plate with clamped edges, NACA TN 847 (1942), table 1), series
//   of
//          von Karman's equations, four digits; solid elements lie 1 to 2.5 % below at the top end: 3 % asked
#include <Eigen/SparseCholesky>

#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

CaseSpec elastic_plate(int elements, double poissons_ratio) {
  CaseSpec spec = testing::plate_case(elements, true);
  spec.plate.material.law = MaterialLaw::elastic;
  spec.plate.material.poissons_ratio = poissons_ratio;
  return spec;
}

/// Load of a dead pressure [Pa] on the free components, in their order.
Eigen::VectorXd pressure_load(const PlateHex64& model, double pressure) {
  const PlateMesh& mesh = model.plate().mesh();
  const SurfaceMap map(mesh);
  std::vector<Vec3> nodal(mesh.node_count());
  map.to_nodes(testing::pressure_force(mesh, pressure), nodal);
  std::vector<double> load;
  for (std::size_t i = 0; i < nodal.size(); ++i) {
    if ((mesh.fixed[i] & fixed_x) == 0) load.push_back(nodal[i].x);
    if ((mesh.fixed[i] & fixed_y) == 0) load.push_back(nodal[i].y);
    if ((mesh.fixed[i] & fixed_z) == 0) load.push_back(nodal[i].z);
  }
  return Eigen::Map<Eigen::VectorXd>(load.data(), static_cast<Eigen::Index>(load.size()));
}

/// Moves `u` to equilibrium under `load`.
void balance(RelaxationProblem& plate, const Eigen::VectorXd& load, std::vector<double>& u) {
  std::vector<double> f(u.size());
  for (int round = 0; round < 30; ++round) {
    ASSERT_TRUE(plate.internal_force(u, 0.0, f)) << "an element turned inside out";
    const Eigen::VectorXd left = load - Eigen::Map<const Eigen::VectorXd>(f.data(), load.size());
    if (left.norm() < 1e-8 * load.norm()) return;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(plate.stiffness(u));
    const Eigen::VectorXd step = factor.solve(left);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += step[static_cast<Eigen::Index>(i)];
  }
  FAIL() << "Newton's method did not converge";
}

TEST(ClampedPlate_SmallPressure, TenByTen_BendsAsTimoshenko) {
  PlateHex64 model(elastic_plate(10, 0.3), 1);
  RelaxationProblem& plate = *model.relaxation();
  std::vector<double> u(static_cast<std::size_t>(plate.dofs()), 0.0);
  const double q = 100.0, a = 0.406, bending = 195e9 * std::pow(0.0034, 3) / (12.0 * (1.0 - 0.09));
  balance(plate, pressure_load(model, q), u);
  const double expected = 0.00126532 * q * std::pow(a, 4) / bending;
  EXPECT_NEAR(plate.centre_deflection(u) / expected, 1.0, 0.01) << "of " << 1e3 * expected << " mm";
}

TEST(ClampedPlate_LargePressure, TenByTen_StretchesAsLevysSeries) {
  PlateHex64 model(elastic_plate(10, 0.316), 1);
  RelaxationProblem& plate = *model.relaxation();
  std::vector<double> u(static_cast<std::size_t>(plate.dofs()), 0.0);
  const double h = 0.0034, unit = 195e9 * std::pow(h / 0.406, 4);
  for (const auto& [load, expected] : {std::pair{17.79, 0.237}, {63.4, 0.695}, {184.0, 1.323}, {402.0, 1.902}}) {
    ASSERT_NO_FATAL_FAILURE(balance(plate, pressure_load(model, load * unit), u));
    EXPECT_NEAR(plate.centre_deflection(u) / h, expected, 0.03 * expected) << "w / h at q a^4 / E h^4 = " << load;
  }
}

}  // namespace
}  // namespace standoff::structure
