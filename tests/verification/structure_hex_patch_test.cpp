// The 64-node hexahedron: patch test on distorted cubic elements, rigid body modes, sum factorisation and lanes.
// Patch test (Irons): a linear displacement field must give constant stress on any element shape, and forces that
// vanish at nodes inside a patch. 4x4x4 Gauss integrates the gradient of distorted cubic shapes exactly (degree 7 a
// direction), so the residual is rounding: eps times about 1e3 operations, 1e-11 of the largest nodal force.
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "structure_solver/step/hex_force.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using Frozen = Metal<Hardening::none, RateLaw::none, false, false>;

MetalParameters elastic_metal() {
  MaterialSpec m = testing::al6xn();
  m.A = 1e15;
  return metal_parameters(m);
}

using Nodal = double[3][hex_nodes];

/// Nodes of one of two elements side by side in x, inner nodes moved off the grid.
void distorted_nodes(int element, Nodal& x) {
  for (int a = 0; a < hex_nodes; ++a) {
    const auto i = static_cast<std::size_t>(a);
    const double p = lobatto_node[i & 3] + 2.0 * element, q = lobatto_node[i >> 2 & 3], r = lobatto_node[i >> 4];
    x[0][a] = 0.01 * (p + 0.10 * std::sin(q) * r + 0.05 * q * q);
    x[1][a] = 0.01 * (q + 0.12 * p * r - 0.04 * p * p);
    x[2][a] = 0.004 * (r + 0.15 * p * q + 0.06 * std::cos(p));
  }
}

const Mat3<double> uniform{{{0.002, 0.0007, -0.0004}, {0.0001, -0.001, 0.0005}, {0.0003, -0.0002, 0.0012}}};

void linear_field(const Nodal& x, Nodal& u) {
  for (int c = 0; c < 3; ++c)
    for (int a = 0; a < hex_nodes; ++a)
      u[c][a] = uniform.m[c][0] * x[0][a] + uniform.m[c][1] * x[1][a] + uniform.m[c][2] * x[2][a];
}

TEST(Hex64_PatchTest, LinearFieldOnDistortedElements_InnerForcesVanish) {
  const MetalParameters metal = elastic_metal();
  Nodal f[2];
  double largest = 0.0;
  for (int e = 0; e < 2; ++e) {
    Nodal x, u;
    distorted_nodes(e, x);
    linear_field(x, u);
    std::vector<double> history(hex_points * Frozen::fields, 0.0);
    const auto sums = hex_force<Frozen>(metal, CurvedGeometry::of_nodes(x), PointStep{}, true, u, history.data(), f[e]);
    EXPECT_TRUE(sums.sound);
    for (const auto& row : f[e])
      for (const double v : row) largest = std::max(largest, std::fabs(v));
  }
  for (int c = 0; c < 3; ++c)
    for (int k = 1; k < 3; ++k)
      for (int j = 1; j < 3; ++j) {
        EXPECT_NEAR(f[0][c][3 + 4 * j + 16 * k] + f[1][c][4 * j + 16 * k], 0.0, 1e-11 * largest) << "N, shared face";
        EXPECT_NEAR(f[0][c][1 + 4 * j + 16 * k], 0.0, 1e-11 * largest) << "N, inside";
      }
}

TEST(Hex64_PatchTest, LinearFieldOnADistortedElement_StoredEnergyIsThatOfUniformStrain) {
  const MetalParameters metal = elastic_metal();
  Nodal x, u, f;
  distorted_nodes(0, x);
  linear_field(x, u);
  const CurvedGeometry geometry = CurvedGeometry::of_nodes(x);
  std::vector<double> history(hex_points * Frozen::fields, 0.0);
  const auto sums = hex_force<Frozen>(metal, geometry, PointStep{}, true, u, history.data(), f);
  PointHistory<double> s{};
  s.static_stress = 1e15;
  double volume = 0.0;
  for (int q = 0; q < hex_points; ++q) volume += geometry.weight(q);
  const double expected = update_point<Frozen>(metal, uniform, PointStep{}, s).elastic * volume;
  EXPECT_NEAR(sums.elastic / expected, 1.0, 1e-11);
}

// Exactly six: fewer integration points would add spurious ones. The first deforming mode lies ten orders above
// rounding.
TEST(Hex64_Stiffness, FreeElement_HasExactlySixZeroModes) {
  const PlateMesh mesh = make_plate_mesh({{0.01, 0.01, 0.0034}, {1, 1, 1}, false, "free", 8060.0});
  InternalForce forces(mesh, elastic_metal(), {true, Hardening::none, RateLaw::none, false, false}, 1);
  auto k = std::make_unique<std::array<InternalForce::ElementMatrix, 4>>();
  const std::vector<Vec3> rest(mesh.node_count());
  forces.element_stiffness(rest, 0, *k);
  const Eigen::Map<Eigen::MatrixXd> matrix((*k)[0].data(), 192, 192);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
  const double largest = values(191);
  // Zero modes: the error of the difference quotient, 1e-9. Deforming ones: the softest bends an element of aspect 3.
  EXPECT_LT(std::fabs(values(0)), 1e-8 * largest);
  EXPECT_LT(std::fabs(values(5)), 1e-8 * largest);
  EXPECT_GT(values(6), 1e-5 * largest);
}

TEST(Hex64_RigidMotion, LargeRotation_LeavesNoForce) {
  const MetalParameters metal = elastic_metal();
  Nodal x, u, f;
  distorted_nodes(0, x);
  const double c = std::cos(1.1), s = std::sin(1.1);
  for (int a = 0; a < hex_nodes; ++a) {
    u[0][a] = c * x[0][a] - s * x[1][a] - x[0][a] + 0.3;
    u[1][a] = s * x[0][a] + c * x[1][a] - x[1][a];
    u[2][a] = -0.2;
  }
  std::vector<double> history(hex_points * Frozen::fields, 0.0);
  hex_force<Frozen>(metal, CurvedGeometry::of_nodes(x), PointStep{}, true, u, history.data(), f);
  // Gradients of displacements of 0.3 m over 1 mm node spacing: rounding 3e-14 of strain, times 2 G, area 1e-5 m2.
  for (const auto& row : f)
    for (const double v : row) EXPECT_NEAR(v, 0.0, 1e-12 * 2.0 * metal.shear * 1e-4) << "N";
}

TEST(Hex64_Gradient, RandomFields_TransposeIsTheAdjoint) {
  std::array<double, 64> u, out, t[3], g[3];
  for (std::size_t i = 0; i < 64; ++i) {
    u[i] = std::sin(1.3 * static_cast<double>(i));
    for (std::size_t d = 0; d < 3; ++d) t[d][i] = std::cos(0.7 * static_cast<double>(i * (d + 1)));
  }
  hex_gradient<4>(u.data(), g[0].data(), g[1].data(), g[2].data());
  hex_gradient_transpose<4>(t[0].data(), t[1].data(), t[2].data(), out.data());
  double left = 0.0, right = 0.0;
  for (std::size_t i = 0; i < 64; ++i) {
    left += out[i] * u[i];
    for (std::size_t d = 0; d < 3; ++d) right += t[d][i] * g[d][i];
  }
  EXPECT_NEAR(left, right, 1e-12 * (std::fabs(left) + 64.0));
}

}  // namespace
}  // namespace standoff::structure
