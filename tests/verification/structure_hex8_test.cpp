// The 8-node hexahedron of a plate (elements/hex8.hpp), boxes as in the plate, at the size of its 10 x 10 mesh.
//   patch     eight boxes of unequal edges round one node: constant stress leaves no force there; rounding, 1e-11
//   bending   one element bent to u = (k x z, 0, 0), which the nodes of w = -k x^2 / 2 share: energy D k^2 / 2 per area
//             with D = E h^3 / (12 (1 - nu^2)) exactly. Parasitic shear would give (l / h)^2 times as much, no enhanced
//             strain (1 - nu)^2 / (1 - 2 nu) = 1.225. Strains of 1e-6: 1e-5 asked
//   modes     exactly six without stiffness: no hourglass
//   rotation  turned as a whole, flowing metal included, forces turn with it. The enhanced strain is solved to 1e-11
#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "structure_solver/step/hex8_force.hpp"
#include "tests/unit/structure_plate_case.hpp"
#include "tests/verification/structure_shell_case.hpp"

namespace standoff::structure {
namespace {

using Nodal = double[3][8];
using Flow = Metal<Hardening::power, RateLaw::none, false, false>;
const Vec3 edges{0.0135, 0.0135, 0.0034};

MetalParameters metal() {
  return metal_parameters(testing::al6xn());
}

Vec3 corner(const Vec3& e, int a) {
  return {a & 1 ? e.x : 0.0, a & 2 ? e.y : 0.0, a & 4 ? e.z : 0.0};
}

template <class Law>
ElementSums<double> force_of(const Vec3& e, const Nodal& u, Nodal& f) {
  std::vector<double> history(8 * std::size_t(Law::fields) + 1, 0.0);
  for (int q = 0; q < 8; ++q)
    if constexpr (Law::static_stress_field >= 0)
      history[std::size_t(q * Law::fields + Law::static_stress_field)] = 410e6;
  double alpha = 0.0;
  return hex8_force<Law>(metal(), BoxGeometryOf<2>::of_edges(e.x, e.y, e.z), PointStep{0.0, true}, true, u,
                         history.data(), alpha, f);
}

void set(Nodal& u, int a, const Vec3& v) {
  u[0][a] = v.x, u[1][a] = v.y, u[2][a] = v.z;
}

Vec3 get(const Nodal& f, int a) {
  return {f[0][a], f[1][a], f[2][a]};
}

TEST(Hex8_PatchTest, EightUnequalBoxes_LeaveNoForceOnTheInnerNode) {
  Vec3 sum;
  double largest = 0.0;
  for (int box = 0; box < 8; ++box) {
    const Vec3 e{box & 1 ? 0.009 : 0.014, box & 2 ? 0.017 : 0.006, box & 4 ? 0.0013 : 0.0034};
    const Vec3 start{box & 1 ? 0.0 : -e.x, box & 2 ? 0.0 : -e.y, box & 4 ? 0.0 : -e.z};
    Nodal u, f;
    for (int a = 0; a < 8; ++a) {
      const Vec3 x = start + corner(e, a);
      set(u, a, 1e-3 * Vec3{2.0 * x.x + 0.7 * x.y - 0.4 * x.z, 0.1 * x.x - x.y + 0.5 * x.z, 0.3 * x.x + 1.2 * x.z});
    }
    EXPECT_TRUE(force_of<Elastic>(e, u, f).sound);
    sum += get(f, 7 - box);
    largest = std::max(largest, norm(get(f, 7 - box)));
  }
  EXPECT_LT(norm(sum), 1e-11 * largest) << "N of " << largest;
}

TEST(Hex8_Bending, OneElementThick_HasTheEnergyOfAPlate) {
  const double k = 1e-6 / (0.5 * edges.z), nu = 0.3;
  Nodal u, f;
  for (int a = 0; a < 8; ++a) {
    const Vec3 x = corner(edges, a) - 0.5 * edges;
    set(u, a, {k * x.x * x.z, 0.0, 0.0});
  }
  const double energy = force_of<Elastic>(edges, u, f).elastic;
  const double stiffness = 195e9 * std::pow(edges.z, 3) / (12.0 * (1.0 - nu * nu));
  EXPECT_NEAR(energy / (0.5 * stiffness * k * k * edges.x * edges.y), 1.0, 1e-5);
}

TEST(Hex8_Stiffness, FreeElement_HasExactlySixZeroModes) {
  const PlateMesh mesh = make_plate_mesh({edges, {1, 1, 1}, false, "free", 8060.0, 0.0, 2});
  InternalForce forces(mesh, metal(), {false, Hardening::none, RateLaw::none, false, false}, 1);
  auto k = std::make_unique<std::array<InternalForce::ElementMatrix, 4>>();
  forces.element_stiffness(std::vector<Vec3>(mesh.node_count()), 0, *k);
  const Eigen::Map<Eigen::MatrixXd> matrix((*k)[0].data(), 24, 24);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
  EXPECT_LT(std::max(std::fabs(values(0)), std::fabs(values(5))), 1e-7 * values(23)) << "N/m";
  EXPECT_GT(values(6), 1e-4 * values(23)) << "N/m: a mode that does not deform";
}

/// A shape stretched, bent, sheared and twisted by `size`, then turned by `angle`.
void deform(double size, double angle, Nodal& u) {
  const Vec3 axis = (1.0 / std::sqrt(0.7)) * Vec3{0.6, -0.5, 0.3};
  for (int a = 0; a < 8; ++a) {
    const double i = a;
    const Vec3 x = corner(edges, a);
    const Vec3 wiggle{std::sin(1.0 + 2.3 * i), std::cos(0.4 + 1.7 * i), std::sin(0.2 + 3.1 * i)};
    set(u, a, testing::rotated(x + size * edges.z * wiggle, axis, angle) - x);
  }
}

TEST(Hex8_Rotation, TurnedAsAWhole_ForcesTurnWithItAndAlone_ThereAreNone) {
  Nodal u, still, turned;
  deform(0.03, 0.0, u);
  const auto a = force_of<Flow>(edges, u, still);
  deform(0.03, 1.9, u);
  const auto b = force_of<Flow>(edges, u, turned);
  ASSERT_GT(a.inelastic, 0.1 * a.elastic) << "J: the metal flows";
  EXPECT_NEAR(b.elastic / a.elastic, 1.0, 1e-8);
  EXPECT_NEAR(b.inelastic / a.inelastic, 1.0, 1e-8);
  const Vec3 axis = (1.0 / std::sqrt(0.7)) * Vec3{0.6, -0.5, 0.3};
  for (int n = 0; n < 8; ++n)
    EXPECT_LT(norm(testing::rotated(get(still, n), axis, 1.9) - get(turned, n)), 1e-8 * norm(get(still, n))) << "N";
  deform(0.0, 2.5, u);
  EXPECT_LT(force_of<Elastic>(edges, u, still).elastic, 1e-15) << "J";
}

// f = dW/du with the enhanced strain free to follow: relaxation and the books rest on it. Central differences over 1e-4
// of the thickness: 1e-6 of the force.
TEST(Hex8_Force, InEveryDirection_IsTheSlopeOfTheEnergy) {
  Nodal u, f, unused;
  deform(0.05, 0.7, u);
  force_of<Elastic>(edges, u, f);
  double scale = 0.0;
  for (int a = 0; a < 8; ++a) scale = std::max(scale, norm(get(f, a)));
  const double delta = 1e-5 * edges.z;
  for (int a = 0; a < 8; ++a)
    for (auto& row : u) {
      const double before = row[a];
      row[a] = before + delta;
      const double above = force_of<Elastic>(edges, u, unused).elastic;
      row[a] = before - delta;
      const double below = force_of<Elastic>(edges, u, unused).elastic;
      row[a] = before;
      EXPECT_NEAR(0.5 * (above - below) / delta, f[&row - u][a], 1e-6 * scale) << "N, node " << a;
    }
}

}  // namespace
}  // namespace standoff::structure
