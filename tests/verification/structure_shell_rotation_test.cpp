// Rigid motion and objectivity of the 4-node shell, on a distorted quad of 30 mm x 3.4 mm.
// Strains are invariants of the mid-surface and its directors, so a rotation of any size, about any axis, leaves no
// stress: rounding of a_a - e_a (1e-16) times E, area 30 mm x 3.4 mm, is 2e-3 N; couples are h/2 smaller.
#include <Eigen/Eigenvalues>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/verification/structure_shell_case.hpp"

namespace standoff::structure {
namespace {

using testing::rotated;
using testing::slip_of;

constexpr double half = 0.0017;
const Vec3 axis = (1.0 / std::sqrt(0.36 + 0.25 + 0.09)) * Vec3{0.6, -0.5, 0.3};

struct Quad {
  ShellMesh mesh;
  std::vector<Vec3> u{4}, slip{4};
  ShellForce forces;

  explicit Quad(double yield = 1e15)
      : mesh(distorted()), forces(mesh, metal(yield), {true, Hardening::none, RateLaw::none, false, false}, 1) {}
  static MetalParameters metal(double yield) {
    MaterialSpec m = testing::al6xn();
    m.A = yield;
    return metal_parameters(m);
  }
  static ShellMesh distorted() {
    ShellMesh mesh = make_shell_mesh({{0.03, 0.03, 2.0 * half}, {1, 1, 1}, false, "free", 8060.0});
    mesh.position[1] += Vec3{0.004, -0.003, 0.0}, mesh.position[3] += Vec3{0.002, 0.006, 0.0};
    return mesh;
  }
  /// A deformed shape: stretched, bent, sheared, warped; turned as a whole by `angle`.
  void deform(double size, double angle) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto k = static_cast<double>(i);
      const Vec3 wiggle{std::sin(1.0 + 2.3 * k), std::cos(0.4 + 1.7 * k), std::sin(0.2 + 3.1 * k)};
      const Vec3 lean{0.5 * std::cos(2.0 * k), 0.4 * std::sin(1.3 * k), 0.0};
      Vec3 d = size * lean + Vec3{0.0, 0.0, 1.0};
      d = (1.0 / norm(d)) * d;
      const Vec3& x = mesh.position[i];
      u[i] = rotated(x + 0.01 * size * wiggle, axis, angle) - x;
      slip[i] = slip_of(rotated(d, axis, angle), half);
    }
  }
};

TEST(ShellRotation_Rigid, AnyAngle_LeavesNoForce) {
  for (const double angle : {0.3, 1.1, 2.5}) {
    Quad quad;
    quad.deform(0.0, angle);
    const ForceSums sums = quad.forces.evaluate(quad.u, quad.slip, {0.0, true}, true);
    EXPECT_EQ(sums.broken_element, -1);
    EXPECT_LT(sums.elastic, 1e-15) << "J";
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT(norm(quad.forces.on_displacement(i)), 2e-2) << "N at " << angle << " rad";
      EXPECT_LT(norm(quad.forces.on_slip(i)), 2e-2) << "N at " << angle << " rad";
    }
  }
}

// Flow included: the same history, the same stress, forces that turn with the element. 1e-9: plane stress is met to
// 1e-11 in strain, of 1e-2.
TEST(ShellRotation_Deformed, TurnedAsAWhole_ForcesTurnWithIt) {
  Quad still(410e6), turned(410e6);
  still.deform(0.1, 0.0), turned.deform(0.1, 1.9);
  const ForceSums a = still.forces.evaluate(still.u, still.slip, {0.0, true}, true);
  const ForceSums b = turned.forces.evaluate(turned.u, turned.slip, {0.0, true}, true);
  ASSERT_GT(a.inelastic, 0.1 * a.elastic) << "J: the metal flows";
  EXPECT_NEAR(b.elastic / a.elastic, 1.0, 1e-9);
  EXPECT_NEAR(b.inelastic / a.inelastic, 1.0, 1e-9);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 f = still.forces.on_displacement(i);
    EXPECT_LT(norm(rotated(f, axis, 1.9) - turned.forces.on_displacement(i)), 1e-9 * norm(f)) << "N";
  }
}

// Exactly six: the seventh deforms. Zero modes carry the error of the difference quotient, 1e-9 of the largest.
TEST(ShellStiffness_FreeElement, AtRest_HasExactlySixZeroModes) {
  Quad quad;
  ShellForce::ElementMatrix k = quad.forces.element_stiffness(0, quad.u, quad.slip);
  const Eigen::Map<Eigen::MatrixXd> matrix(k.data(), 20, 20);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
  EXPECT_LT(std::max(std::fabs(values(0)), std::fabs(values(5))), 1e-8 * values(19)) << "N/m";
  EXPECT_GT(values(6), 1e-4 * values(19)) << "N/m: a mode that does not deform";
}

// f = dW/du with frozen flow, slips of 0.5 rad and more included: relaxation and the energy books rest on it. Central
// differences of the energy over 1e-6 of the size: 1e-6 of the force.
TEST(ShellForce_Deformed, InAnyDirection_IsTheSlopeOfTheEnergy) {
  Quad quad;
  quad.deform(0.3, 0.7);
  quad.forces.evaluate(quad.u, quad.slip, {0.0, false}, false);
  std::vector<Vec3> f(4), couple(4);
  double scale = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    f[i] = quad.forces.on_displacement(i), couple[i] = quad.forces.on_slip(i);
    scale = std::max({scale, norm(f[i]), norm(couple[i])});
  }
  static constexpr double Vec3::*components[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
  for (std::size_t i = 0; i < 20; ++i) {
    const bool slips = i % 5 > 2;
    double& moved = (slips ? quad.slip : quad.u)[i / 5].*components[i % 5 % 3];
    const double delta = slips ? 1e-8 : 1e-7, before = moved;
    moved = before + delta;
    const double above = quad.forces.evaluate(quad.u, quad.slip, {0.0, false}, false).elastic;
    moved = before - delta;
    const double below = quad.forces.evaluate(quad.u, quad.slip, {0.0, false}, false).elastic;
    moved = before;
    EXPECT_NEAR(0.5 * (above - below) / delta, (slips ? couple : f)[i / 5].*components[i % 5 % 3], 1e-6 * scale)
        << "N, component " << i;
  }
}

}  // namespace
}  // namespace standoff::structure
