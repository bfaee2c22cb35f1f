// The 4-node shell on a distorted patch (MacNeal & Harder, Finite Elem. Anal. Des. 1 (1985) 3: five quads, 240 mm x 120
// mm x 1 mm): states of constant strain must be exact on any element shape.
//   stretch    Hencky plate in plane stress: W = E h / (2 (1 - nu^2)) (e1^2 + e2^2 + 2 nu e1 e2), e_i = log of the
//              stretches; zero normal stress is met to 1e-11 in strain, so energy to 1e-9, forces to rounding (1e-10)
//   curvature  W = D/2 (k1^2 + k2^2 + 2 nu k1 k2 + 2 (1 - nu) k12^2), taken at rotations of 2e-6: membrane strains of
//              second order weigh (theta L / h)^2 = 2e-7 of it, so 1e-6. Odd part of the force: they cancel there
//   shear      W = kappa G h / 2 gamma^2
#include <cmath>

#include <gtest/gtest.h>

#include "tests/verification/structure_shell_case.hpp"

namespace standoff::structure {
namespace {

constexpr double thickness = 0.001, E = 195e9, nu = 0.3;
const std::array<Vec3, 8> at{{{0.0, 0.0, 0.0},
                              {0.24, 0.0, 0.0},
                              {0.24, 0.12, 0.0},
                              {0.0, 0.12, 0.0},
                              {0.04, 0.02, 0.0},
                              {0.18, 0.03, 0.0},
                              {0.16, 0.08, 0.0},
                              {0.08, 0.08, 0.0}}};
constexpr std::size_t quads[5][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
constexpr double area = 0.24 * 0.12;

struct Patch {
  std::array<Vec3, 8> u{}, lean{}, force{}, couple{};
  double energy = 0.0, largest_force = 0.0, largest_couple = 0.0;

  void evaluate() {
    const MetalParameters metal = metal_parameters(testing::al6xn());
    force = couple = {}, energy = 0.0;
    for (const auto& quad : quads) {
      std::array<Vec3, 4> rest;
      ShellMotion motion;
      for (std::size_t a = 0; a < 4; ++a)
        rest[a] = at[quad[a]], motion.u[a] = u[quad[a]], motion.lean[a] = lean[quad[a]];
      std::vector<Pack4> history(shell_layers, Pack4(0.0));
      ShellForces f;
      const ShellSums sums = shell_force<Elastic>(metal, ShellGeometry::of_nodes(rest), thickness, PointStep{}, true,
                                                  motion, history.data(), f);
      EXPECT_TRUE(sums.sound);
      energy += sums.elastic;
      for (std::size_t a = 0; a < 4; ++a) {
        force[quad[a]] += f.force[a], couple[quad[a]] += f.couple[a];
        largest_force = std::max(largest_force, norm(f.force[a]));
        largest_couple = std::max(largest_couple, norm(f.couple[a]));
      }
    }
  }
};

TEST(ShellPatch_Stretch, LinearFieldOnDistortedQuads_IsExact) {
  const double stretch_x = 1.02, stretch_y = 0.985;
  Patch patch;
  for (std::size_t i = 0; i < 8; ++i) patch.u[i] = {(stretch_x - 1.0) * at[i].x, (stretch_y - 1.0) * at[i].y, 0.3};
  patch.evaluate();
  const double a = std::log(stretch_x), b = std::log(stretch_y);
  const double expected = 0.5 * E * thickness / (1.0 - nu * nu) * (a * a + b * b + 2.0 * nu * a * b) * area;
  EXPECT_NEAR(patch.energy / expected, 1.0, 1e-9) << "J of " << expected;
  for (std::size_t i = 4; i < 8; ++i) {
    EXPECT_LT(norm(patch.force[i]), 1e-10 * patch.largest_force) << "N at an inner node";
    EXPECT_LT(norm(patch.couple[i]), 1e-10 * thickness * patch.largest_force) << "N m";
  }
}

TEST(ShellPatch_Curvature, QuadraticFieldOnDistortedQuads_IsExact) {
  const double k1 = 6e-6, k2 = -2e-6, k12 = 3e-6;  // 1/m
  Patch up, down;
  for (std::size_t i = 0; i < 8; ++i) {
    const double x = at[i].x, y = at[i].y;
    up.u[i] = {0.0, 0.0, 0.5 * (k1 * x * x + k2 * y * y) + k12 * x * y};
    up.lean[i] = {-(k1 * x + k12 * y), -(k2 * y + k12 * x), 0.0};
    down.u[i] = -up.u[i], down.lean[i] = -up.lean[i];
  }
  up.evaluate(), down.evaluate();
  const double d = E * std::pow(thickness, 3) / (12.0 * (1.0 - nu * nu));
  const double expected = 0.5 * d * (k1 * k1 + k2 * k2 + 2.0 * nu * k1 * k2 + 2.0 * (1.0 - nu) * k12 * k12) * area;
  EXPECT_NEAR(up.energy / expected, 1.0, 1e-6) << "J of " << expected;
  for (std::size_t i = 4; i < 8; ++i) {
    EXPECT_LT(norm(up.force[i] - down.force[i]), 1e-6 * up.largest_couple / 0.04) << "N at an inner node";
    EXPECT_LT(norm(up.couple[i] - down.couple[i]), 1e-6 * up.largest_couple) << "N m";
  }
}

TEST(ShellPatch_Shear, TiltedMidSurfaceUnderUprightDirectors_HasItsEnergy) {
  const double gamma = 1e-5;
  Patch patch;
  for (std::size_t i = 0; i < 8; ++i) patch.u[i] = {0.0, 0.0, gamma * (0.6 * at[i].x + 0.8 * at[i].y)};
  patch.evaluate();
  const double expected = 0.5 * 5.0 / 6.0 * E / (2.0 * (1.0 + nu)) * thickness * gamma * gamma * area;
  EXPECT_NEAR(patch.energy / expected, 1.0, 1e-8) << "J of " << expected;
}

}  // namespace
}  // namespace standoff::structure
