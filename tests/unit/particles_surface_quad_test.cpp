// Law: the foot of a position on a bilinear quad is the minimum of the distance over the patch: the offset is normal to
// the patch inside, and no sampled point is nearer. Weights sum to one and reproduce the point (definition of the map).
// Tolerances: Newton stops at an error of 1e-15 in xi, so offset . tangent vanishes to about 1e-14 of |offset||tangent|
// plus rounding of the corners, 1e-12 asked; a sample can only be farther, up to rounding.
#include <gtest/gtest.h>

#include "particle_solver/kernels/bilinear_quad.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using test::between;
using test::random_vector;

/// A convex quad of about one metre, out of plane by up to `warp`.
std::array<Vec3, 4> random_quad(CounterRandom& random, double warp) {
  std::array<Vec3, 4> x{{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}};
  for (Vec3& corner : x) {
    const Vec3 shift = random_vector(random, 1.0);
    corner += Vec3{0.15 * shift.x, 0.15 * shift.y, warp * shift.z};
  }
  return x;
}

TEST(BilinearQuad_WithAnyCorners, WeightsSumToOneAndReproduceThePoint) {
  CounterRandom random(1, RandomUse::test, 1);
  for (int i = 0; i < 1000; ++i) {
    const auto x = random_quad(random, 0.2);
    const double xi = between(random, -1, 1), eta = between(random, -1, 1);
    const auto weight = bilinear_weights(xi, eta);
    Vec3 sum;
    for (std::size_t a = 0; a < 4; ++a) sum += x[a] * weight[a];
    EXPECT_NEAR(weight[0] + weight[1] + weight[2] + weight[3], 1.0, 4e-16);
    EXPECT_LT(norm(sum - bilinear_quad(x).point(xi, eta)), 1e-15) << "m";
  }
}

TEST(QuadFoot_SeenFromAnywhere, IsNoFartherThanAnySample) {
  CounterRandom random(1, RandomUse::test, 2);
  int inside = 0, border = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto x = random_quad(random, 0.1);
    const Vec3 p = random_vector(random, 1.0);
    const QuadFoot foot = quad_foot(x, p);
    const BilinearQuad quad = bilinear_quad(x);
    ASSERT_LE(std::abs(foot.xi), 1.0);
    ASSERT_LE(std::abs(foot.eta), 1.0);
    ASSERT_NEAR(norm(quad.point(foot.xi, foot.eta) - p), std::sqrt(foot.squared_distance), 1e-14);
    for (int a = 0; a <= 20; ++a)
      for (int b = 0; b <= 20; ++b)
        ASSERT_GE(squared_norm(quad.point(a / 10.0 - 1.0, b / 10.0 - 1.0) - p), foot.squared_distance * (1 - 1e-13))
            << "quad " << i << " sample " << a << ' ' << b;
    ++(foot.border ? border : inside);
  }
  EXPECT_GT(inside, 200);  // both branches were met
  EXPECT_GT(border, 200);
}

TEST(QuadFoot_InsideAWarpedQuad, HasItsOffsetAlongTheNormal) {
  CounterRandom random(1, RandomUse::test, 3);
  for (int i = 0; i < 2000; ++i) {
    const auto x = random_quad(random, 0.1);
    const BilinearQuad quad = bilinear_quad(x);
    const double xi = between(random, -0.95, 0.95), eta = between(random, -0.95, 0.95);
    const double gap = between(random, -0.3, 0.3);
    const Vec3 p = quad.point(xi, eta) + quad.normal(xi, eta) * gap;  // its foot is (xi, eta) by construction
    const QuadFoot foot = quad_foot(x, p);
    ASSERT_NEAR(foot.xi, xi, 1e-12) << "gap " << gap;
    ASSERT_NEAR(foot.eta, eta, 1e-12);
  }
}

TEST(QuadFoot_OnALongTrapezoidOfTheRing, IsFoundByNewton) {
  // 0.1 m long, 3.4 mm wide inside, 5 mm outside, beside the diagonal: the most distorted face of a surround.
  const std::array<Vec3, 4> x{{{0.2, 0.2, 0}, {0.2, 0.1966, 0}, {0.3, 0.295, 0}, {0.3, 0.3, 0}}};
  CounterRandom random(1, RandomUse::test, 4);
  for (int i = 0; i < 1000; ++i) {
    const double xi = between(random, -1, 1), eta = between(random, -1, 1);
    const QuadFoot foot = quad_foot(x, bilinear_quad(x).point(xi, eta) + Vec3{0, 0, 1e-3});
    ASSERT_NEAR(foot.xi, xi, 1e-11);  // 1e-16 m * 0.2 m / (half a width)
    ASSERT_NEAR(foot.eta, eta, 1e-11);
  }
}

}  // namespace
}  // namespace standoff::particles
