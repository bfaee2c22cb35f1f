// The 27-node hexahedron on distorted (trilinear) elements.
//   linear     Irons' patch test: constant stress, no force at nodes inside; rounding, 1e-11 of the largest force
//   quadratic  u_i = X.Q_i X / 2 on trilinear shapes is contained in the 27 functions; in equilibrium with the constant
//              body force b = -div sigma, so that nodes inside feel f_a = integral of N_a b. 3 x 3 x 3 Gauss integrates
//              both exactly (degree 5 a direction). Taken at strains of 1e-7 as the odd part of the force, so that what
//              is left of the finite strains is of third order: 1e-12; rounding of displacements of 1e-9 m: 1e-8
//   modes      exactly the six rigid ones have no stiffness
#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "structure_solver/step/hex_force.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using Geometry = CurvedGeometryOf<3>;
using Nodal = double[3][27];
constexpr int shared_face[2] = {2 + 3 * 1 + 9 * 1, 0 + 3 * 1 + 9 * 1}, inside = 13;  // local numbers

MetalParameters metal() {
  return metal_parameters(testing::al6xn());
}

/// Nodes of one of two elements side by side in x: trilinear images of the cube, no two edges alike.
void distorted_nodes(int element, Nodal& x) {
  for (std::size_t a = 0; a < 27; ++a) {
    const Line4& node = line_basis<3>.node;
    const double p = node[a % 3] + 2.0 * element, q = node[a / 3 % 3], r = node[a / 9];
    x[0][a] = 0.010 * (p + 0.10 * q + 0.08 * r + 0.05 * q * r);
    x[1][a] = 0.010 * (q + 0.07 * p * r - 0.06 * p);
    x[2][a] = 0.004 * (r + 0.12 * p * q + 0.05 * p);
  }
}

/// Forces of both elements under the field u(X) = size * field(X).
template <class Field>
void forces(const Field& field, double size, Nodal (&f)[2]) {
  for (int e = 0; e < 2; ++e) {
    Nodal x, u;
    distorted_nodes(e, x);
    for (int a = 0; a < 27; ++a) {
      const Vec3 move = size * field(Vec3{x[0][a], x[1][a], x[2][a]});
      u[0][a] = move.x, u[1][a] = move.y, u[2][a] = move.z;
    }
    EXPECT_TRUE(
        hex_force<Elastic>(metal(), Geometry::of_nodes(x), PointStep{}, true, u, static_cast<double*>(nullptr), f[e])
            .sound);
  }
}

double largest_of(const Nodal (&f)[2]) {
  double largest = 0.0;
  for (const Nodal& one : f)
    for (const auto& row : one)
      for (const double v : row) largest = std::max(largest, std::fabs(v));
  return largest;
}

TEST(Hex27_PatchTest, LinearFieldOnDistortedElements_InnerForcesVanish) {
  Nodal f[2];
  forces(
      [](const Vec3& x) {
        return Vec3{2 * x.x + 0.7 * x.y - 0.4 * x.z, 0.1 * x.x - x.y, 0.3 * x.x + 1.2 * x.z};
      },
      1e-3, f);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(f[0][c][shared_face[0]] + f[1][c][shared_face[1]], 0.0, 1e-11 * largest_of(f)) << "N, shared face";
    EXPECT_NEAR(f[0][c][inside], 0.0, 1e-11 * largest_of(f)) << "N, inside";
  }
}

// div sigma = (lambda + G) grad div u + G laplace u. Here div u = a x + b y + c z with the sums below.
TEST(Hex27_PatchTest, QuadraticFieldOnDistortedElements_BalancesItsBodyForce) {
  const auto field = [](const Vec3& x) {
    return Vec3{x.x * x.x + 2.0 * x.x * x.y - x.z * x.z, 3.0 * x.y * x.y + x.y * x.z, x.x * x.z - 2.0 * x.z * x.z};
  };
  const double shear = metal().shear, lambda = metal().bulk - 2.0 / 3.0 * shear;
  const Vec3 grad_div{2.0 + 0.0 + 1.0, 2.0 + 6.0, 1.0 - 4.0}, laplace{2.0 - 2.0, 6.0, -4.0};
  const double size = 1e-5;
  const Vec3 body = -size * ((lambda + shear) * grad_div + shear * laplace);
  Nodal plus[2], minus[2];
  forces(field, size, plus), forces(field, -size, minus);
  const double scale = largest_of(plus);
  Vec3 at_face, at_inside, load_face, load_inside;
  for (int e = 0; e < 2; ++e) {
    Nodal x;
    distorted_nodes(e, x);
    const Geometry g = Geometry::of_nodes(x);
    auto add = [&](int node, Vec3& force, Vec3& load) {
      force += 0.5 * Vec3{plus[e][0][node] - minus[e][0][node], plus[e][1][node] - minus[e][1][node],
                          plus[e][2][node] - minus[e][2][node]};
      const auto a = static_cast<std::size_t>(node);
      for (std::size_t q = 0; q < 27; ++q) {
        const Matrix4& n = line_basis<3>.to_gauss;
        load += n[q % 3][a % 3] * n[q / 3 % 3][a / 3 % 3] * n[q / 9][a / 9] * g.weight(static_cast<int>(q)) * body;
      }
    };
    add(shared_face[e], at_face, load_face);
    if (e == 0) add(inside, at_inside, load_inside);
  }
  ASSERT_GT(norm(load_inside), 0.01 * scale);
  EXPECT_LT(norm(at_face - load_face), 1e-8 * scale) << "N of " << scale;
  EXPECT_LT(norm(at_inside - load_inside), 1e-8 * scale) << "N of " << scale;
}

TEST(Hex27_Stiffness, FreeElement_HasExactlySixZeroModes) {
  const PlateMesh mesh = make_plate_mesh({{0.01, 0.01, 0.0034}, {1, 1, 1}, false, "free", 8060.0, 0.0, 3});
  InternalForce forces(mesh, metal(), {false, Hardening::none, RateLaw::none, false, false}, 1);
  auto k = std::make_unique<std::array<InternalForce::ElementMatrix, 4>>();
  forces.element_stiffness(std::vector<Vec3>(mesh.node_count()), 0, *k);
  const Eigen::Map<Eigen::MatrixXd> matrix((*k)[0].data(), 81, 81);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
  EXPECT_LT(std::max(std::fabs(values(0)), std::fabs(values(5))), 1e-8 * values(80)) << "N/m";
  EXPECT_GT(values(6), 1e-5 * values(80)) << "N/m: a mode that does not deform";
}

}  // namespace
}  // namespace standoff::structure
