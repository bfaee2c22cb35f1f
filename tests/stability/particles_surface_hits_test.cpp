// Law: a passive collision of bodies with finite masses cannot create energy (Goldsmith, Impact, 1960, ch. 2), however
// many hits fall into one window on the same few nodes: each must meet the wall as the hits before it left it. Judged
// by the energy of all particles and of the local nodal motion, which the sheet keeps itself until the next exchange.
// Tolerance: 1000 hits a window, each rounding the energy by a few 1e-16 of it.
#include <gtest/gtest.h>

#include "particle_solver/state/surface_sheet.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

struct Bombardment {
  SurfaceMesh mesh;
  SurfaceSheet sheet;
  double mass;
  std::vector<Vec3> velocity;

  Bombardment(double node_mass, double particle_mass, int particles)
      : mesh(flat_mesh(4, 0.2, node_mass)), sheet(mesh, {}), mass(particle_mass) {
    CounterRandom random(6, RandomUse::test, 1);
    for (int i = 0; i < particles; ++i) velocity.push_back(Vec3{0, 0, -1000} + random_vector(random, 500.0));
  }
  double energy() const {
    double sum = 0.0;
    for (const Vec3& v : velocity) sum += 0.5 * mass * squared_norm(v);
    for (std::size_t n = 0; n < mesh.node_mass.size(); ++n)
      sum += 0.5 * mesh.node_mass[n] * squared_norm(sheet.node_velocity()[n]);
    return sum;
  }
  Vec3 momentum() const {
    Vec3 sum;
    for (const Vec3& v : velocity) sum += v * mass;
    for (std::size_t n = 0; n < mesh.node_mass.size(); ++n) sum += sheet.node_velocity()[n] * mesh.node_mass[n];
    return sum;
  }
};

class ManyHitsInOneWindow : public testing::TestWithParam<double> {};  // particle mass over node mass

TEST_P(ManyHitsInOneWindow, OnOneNodeOfALightSheet_CreateNoEnergyAndKeepMomentum) {
  long hits = 0;
  for (const double restitution : {0.0, 0.7, 1.0})
    for (int window = 0; window < 20; ++window) {
      Bombardment b(1e-3, 1e-3 * GetParam(), 1000);
      const double initial = b.energy();
      const Vec3 momentum = b.momentum();
      CounterRandom random(6, RandomUse::test, 2, static_cast<std::uint32_t>(window));
      double before = initial, loss = 0.0;
      for (Vec3& v : b.velocity) {
        const Vec3 p{between(random, -0.02, 0.02), between(random, -0.02, 0.02), 1e-3};  // all around node 12
        const Impact hit = b.sheet.collide(b.sheet.closest(p, 1.0), b.mass, restitution, 0.2, 1e-8, v);
        loss += hit.loss, hits += hit.impulse.z != 0.0;
        const double now = b.energy();
        ASSERT_LE(now, before + 1e-13 * initial) << "J, hit " << hits << " restitution " << restitution;
        before = now;
      }
      EXPECT_NEAR(before + loss, initial, 1e-11 * initial) << "J: losses are booked";
      EXPECT_LT(norm(b.momentum() - momentum), 1e-11 * norm(momentum)) << "N s";
    }
  EXPECT_GT(hits, 60) << "at least one in each window; few where each throws the wall far ahead of the others";
}

INSTANTIATE_TEST_SUITE_P(MassRatios, ManyHitsInOneWindow, testing::Values(0.001, 0.1, 1.0, 30.0));

TEST(ManyElasticHitsInOneWindow, AcrossRebuildsOfTheBins_KeepEnergy) {
  // Wall points run off at up to hundreds of m/s between hits, through many rebuilds and steep local folds.
  Bombardment b(1e-3, 5e-4, 500);
  const double initial = b.energy();
  CounterRandom random(6, RandomUse::test, 3);
  for (int step = 0; step < 40; ++step, b.sheet.drift(2e-7))
    for (Vec3& v : b.velocity) {
      const Vec3 p{between(random, -0.15, 0.15), between(random, -0.15, 0.15), 1e-3};
      const SheetPoint where = b.sheet.closest(p, 0.2, 1e-7);
      if (where.face >= 0) b.sheet.collide(where, b.mass, 1.0, 0.0, 1e-7, v);
    }
  EXPECT_NEAR(b.energy(), initial, 1e-11 * initial) << "J";
}

}  // namespace
}  // namespace standoff::particles
