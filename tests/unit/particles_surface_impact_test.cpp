// Laws of one impact with a surface point of finite mass m_w, 1/m_w = sum N_a^2 / m_a (Goldsmith, Impact, 1960, ch. 2):
// nodes and particle exchange the impulse J exactly, the moments about any point agree because the weights reproduce
// the point, e = 1 without friction keeps the energy, e = 0 leaves no normal velocity, friction is at most mu J_n and
// never adds energy. Tolerance: sums of a dozen products, 1e-13 of the quantities' size.
#include <numeric>

#include <gtest/gtest.h>

#include "particle_solver/kernels/surface_impact.hpp"
#include "particle_solver/state/surface_sheet.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

/// A bumpy sheet with uneven nodal masses around that of the particle, 2e-4 kg, all nodes in motion.
struct Scene {
  SurfaceMesh mesh;
  SurfaceMotion motion;
  SheetPoint where;
  Vec3 velocity;
  double mass = 2e-4;
};

Scene random_scene(CounterRandom& random) {
  Scene s;
  s.mesh = sheet_mesh(6, -0.3, 0.3, 1.0, [&](double x, double y) { return Vec3{x, y, between(random, -0.02, 0.02)}; });
  for (double& m : s.mesh.node_mass) m = 1e-4 * between(random, 0.5, 5.0);
  s.motion = at_rest(s.mesh);
  for (Vec3& v : s.motion.velocity) v = random_vector(random, 50.0);
  s.velocity = Vec3{0, 0, -600} + random_vector(random, 300.0);
  return s;
}

/// The sheet of the scene in motion, and a point of it to hit.
SurfaceSheet struck(Scene& s, CounterRandom& random) {
  SurfaceSheet sheet(s.mesh, {});
  sheet.begin_window(s.motion, false);
  s.where = sheet.closest({between(random, -0.2, 0.2), between(random, -0.2, 0.2), 0.03}, 0.1);
  return sheet;
}

/// Of particle and nodes, J.
double energy(const Scene& s, const SurfaceSheet& sheet) {
  double sum = 0.5 * s.mass * squared_norm(s.velocity);
  for (std::size_t n = 0; n < s.mesh.node_mass.size(); ++n)
    sum += 0.5 * s.mesh.node_mass[n] * squared_norm(sheet.node_velocity()[n]);
  return sum;
}
Vec3 momentum(const Scene& s, const SurfaceSheet& sheet) {
  Vec3 sum = s.velocity * s.mass;
  for (std::size_t n = 0; n < s.mesh.node_mass.size(); ++n) sum += sheet.node_velocity()[n] * s.mesh.node_mass[n];
  return sum;
}

TEST(Impact_OnAFreeSheet, SharesForceAndMomentExactly) {
  CounterRandom random(3, RandomUse::test, 1);
  for (int i = 0; i < 200; ++i) {
    Scene s = random_scene(random);
    SurfaceSheet sheet = struck(s, random);
    const Impact hit = sheet.collide(s.where, s.mass, 0.5, 0.3, 0.0, s.velocity);
    ASSERT_LT(hit.impulse.z, 0.0);
    SurfaceLoad load;
    sheet.collect_load(2e-7, load);
    Vec3 force, moment;
    for (std::size_t n = 0; n < load.force.size(); ++n)
      force += load.force[n] * 2e-7, moment += cross(s.motion.position[n], load.force[n] * 2e-7);
    EXPECT_LT(norm(force - hit.impulse), 1e-14 * norm(hit.impulse)) << "N s";
    EXPECT_LT(norm(moment - cross(s.where.point, hit.impulse)), 1e-14 * norm(hit.impulse)) << "N s m";
    EXPECT_LT(norm(sheet.total_impulse() - hit.impulse), 1e-15 * norm(hit.impulse));
  }
}

TEST(Impact_ElasticWithoutFriction, KeepsEnergyAndMomentumOfBoth) {
  CounterRandom random(3, RandomUse::test, 2);
  for (int i = 0; i < 200; ++i) {
    Scene s = random_scene(random);
    SurfaceSheet sheet = struck(s, random);
    const double before = energy(s, sheet), own = 0.5 * s.mass * squared_norm(s.velocity);
    const Vec3 momentum_before = momentum(s, sheet);
    const Impact hit = sheet.collide(s.where, s.mass, 1.0, 0.0, 0.0, s.velocity);
    EXPECT_NEAR(energy(s, sheet), before, 1e-13 * before) << "J";
    EXPECT_LT(norm(momentum(s, sheet) - momentum_before), 1e-13 * s.mass * 600);
    EXPECT_NEAR(hit.work, own - 0.5 * s.mass * squared_norm(s.velocity), 1e-13 * own)
        << "work = what the particle lost";
    EXPECT_NEAR(hit.loss, 0.0, 1e-13 * own);
    EXPECT_EQ(sheet.total_work(), hit.work);
  }
}

TEST(Impact_Inelastic, LeavesNoNormalVelocityAndBooksTheLoss) {
  CounterRandom random(3, RandomUse::test, 3);
  for (int i = 0; i < 200; ++i) {
    Scene s = random_scene(random);
    SurfaceSheet sheet = struck(s, random);
    const double before = energy(s, sheet);
    const Impact hit = sheet.collide(s.where, s.mass, 0.0, 0.2, 0.0, s.velocity);
    EXPECT_NEAR(dot(s.velocity - sheet.velocity_at(s.where), s.where.normal), 0.0, 1e-13 * 600) << "m/s";
    EXPECT_NEAR(energy(s, sheet) + hit.loss, before, 1e-13 * before);
    EXPECT_GT(hit.loss, 0.0);
  }
}

TEST(Impact_WithFriction, IsCoulombLimitedAndEndsSlipAtMost) {
  const SurfaceMesh mesh = flat_mesh(4, 0.2, 1e-3);
  const double m = 2e-4;
  for (const double mu : {0.1, 0.5, 10.0}) {
    SurfaceSheet sheet(mesh, {});
    const SheetPoint where = sheet.closest({0.03, 0.02, 0.01}, 0.1);
    Vec3 v{300.0, 0.0, -400.0};
    const Impact hit = sheet.collide(where, m, 0.0, mu, 0.0, v);
    const double reduced = 1.0 / (1.0 / m + where.inverse_mass), stop = reduced * 300.0;
    EXPECT_NEAR(hit.impulse.z, -reduced * 400.0, 1e-14);
    EXPECT_NEAR(hit.impulse.x, std::min(mu * reduced * 400.0, stop), 1e-14) << "N s, mu " << mu;
    EXPECT_GE(hit.loss, 0.0);
  }
}

TEST(Impact_OnAWallThatAnswersUnevenly, AddsNoEnergy) {
  // A node held by a mirror plane answers along two axes only. Energy change = J.u + J.(1/m + W) J / 2.
  CounterRandom random(3, RandomUse::test, 5);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 side = random_vector(random, 1.0), n = side / norm(side), u = random_vector(random, 1.0);
    const Vec3 answer{between(random, 0.0, 5.0), between(random, 0.0, 5.0), between(random, 0.0, 5.0)};
    const SurfaceImpactLaw law{between(random, 0.0, 1.0), between(random, 0.0, 2.0)};
    const Vec3 j = surface_impulse(law, u, n, 1.0, 1.0, answer);
    EXPECT_LE(dot(j, u) + 0.5 * (squared_norm(j) + dot(j, scaled(answer, j))), 1e-15);
  }
}

TEST(Impact_AtTimeT, LeavesThePlacesAtThatTimeAlone) {
  CounterRandom random(3, RandomUse::test, 4);
  Scene s = random_scene(random);
  SurfaceSheet sheet = struck(s, random);
  const double t = 3e-7;
  std::vector<Vec3> before;
  for (std::size_t n = 0; n < s.mesh.node_mass.size(); ++n)
    before.push_back(sheet.node_position()[n] + sheet.node_velocity()[n] * t);
  sheet.collide(s.where, s.mass, 1.0, 0.0, t, s.velocity);
  for (std::size_t n = 0; n < before.size(); ++n)
    EXPECT_LT(norm(sheet.node_position()[n] + sheet.node_velocity()[n] * t - before[n]), 1e-15) << "m";
}

}  // namespace
}  // namespace standoff::particles
