// Two grains collide: closed forms of the linear spring and dashpot.
//   w0^2 = k/m_red, b = xi w0, w^2 = w0^2 - b^2. With tension, a contact lasts pi/w and e = exp(-pi xi/sqrt(1 - xi^2)).
//   Without tension it ends where the force vanishes: e = exp(-(b/w)(pi - atan2(2 b w, w^2 - b^2))); both follow from
//   overlap = (v/w) exp(-bt) sin(wt). See Schwager, Poeschel, Granular Matter 9, 465 (2007).
// Tolerance: a contact begins and ends inside a step. That shifts energy by at most k (v dt)^2/8, twice: (w0 dt)^2/2 of
// the impact energy, half of it in speed; and it misplaces the dashpot by up to a step: 2 xi w0 dt in ln e.
#include <numbers>

#include <gtest/gtest.h>

#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles {
namespace {

constexpr double radius = 1e-3, mass = 1e-5, stiffness = 1e7;

struct Collision {
  SandState grains;
  SandPairs pairs;
  double energy_before = 0.0;
  double energy_now() const {
    const SandBooks& b = pairs.books();
    return kinetic_energy(grains) + b.elastic_energy + b.friction_loss + b.damping_loss;
  }
};

/// Two grains meet with 100 m/s along x, their centres `offset` diameters apart across; run until long after.
Collision collide(const GrainLaw& law, double offset, double step) {
  Collision c{make_grains({{0, 0, 0}, {2.05 * radius, 2.0 * radius * offset, 0}}, radius, mass),
              SandPairs({law, {}, {}, 0, 1})};
  c.grains.velocity = {{50, 0, 3}, {-50, 0, 3}};
  c.pairs.forces(c.grains, 0.0);
  c.energy_before = c.energy_now();
  for (double t = 0.0; t < 4e-5; t += step) sand_step(c.grains, c.pairs, step);
  return c;
}

double w0_dt(double step) {
  return step * std::sqrt(2.0 * stiffness / mass);
}

TEST(GrainImpact, HeadOnWithDashpot_PartsWithTheRestitutionOfTheClosedForm) {
  for (const double xi : {0.0, 0.01, 0.1, 0.3}) {
    const GrainLaw law{stiffness, 0.0, xi};
    const double step = 0.2 * recommended_step(law, mass);
    const Collision c = collide(law, 0.0, step);
    const double e = (c.grains.velocity[1].x - c.grains.velocity[0].x) / 100.0;
    const double w = std::sqrt(1.0 - xi * xi);
    const double with_tension = std::exp(-std::numbers::pi * xi / w);
    const double expected = std::exp(-xi / w * (std::numbers::pi - std::atan2(2.0 * xi * w, w * w - xi * xi)));
    const double tolerance = 2.0 * xi * w0_dt(step) + 0.25 * w0_dt(step) * w0_dt(step);
    EXPECT_NEAR(std::log(e), std::log(expected), tolerance) << "xi = " << xi;
    EXPECT_GE(e, with_tension * (1.0 - tolerance)) << "the cut at zero force can only raise e, xi = " << xi;
  }
}

TEST(GrainImpact, HeadOnWithoutLosses_KeepsEnergyAndMomentum) {
  const GrainLaw law{stiffness, 0.0, 0.0};
  const double step = recommended_step(law, mass);
  const Collision c = collide(law, 0.0, step);
  EXPECT_NEAR(c.energy_now() / c.energy_before, 1.0, 0.5 * w0_dt(step) * w0_dt(step));
  // Opposite forces are the same bits, so each component of momentum only sees the rounding of the kicks.
  EXPECT_NEAR(momentum(c.grains).x, 0.0, 1e-15 * mass * 100.0 * 200);
  EXPECT_EQ(c.grains.velocity[0].z, c.grains.velocity[1].z);
}

TEST(GrainImpact, GrazingWithFriction_NeverGainsEnergyAndClosesItsBooks) {
  // A history that is not capped or not turned gives energy at grazing hits, up to a third of it.
  for (const double friction : {0.1, 0.3, 1.0})
    for (const double offset : {0.05, 0.2, 0.4, 0.6, 0.8, 0.95}) {
      const GrainLaw law{stiffness, friction, 0.0};
      const double step = recommended_step(law, mass), entry = 0.5 * w0_dt(step) * w0_dt(step);
      const Collision c = collide(law, offset, step);
      const double kept = kinetic_energy(c.grains) / c.energy_before;
      EXPECT_LE(kept, 1.0 + entry) << "mu " << friction << ", offset " << offset;
      EXPECT_NEAR(c.energy_now() / c.energy_before, 1.0, entry) << "mu " << friction << ", offset " << offset;
      // A sticking spring swings back with the normal one (same k, same mass) and may overshoot in the last step.
      EXPECT_GT(c.pairs.books().friction_loss, -entry * c.energy_before);
      if (friction < 0.5 && offset > 0.5 && offset < 0.9) {
        EXPECT_GT(c.pairs.books().friction_loss, 0.01 * c.energy_before);
      }
      EXPECT_LT(c.pairs.books().friction_loss, c.energy_before);
      EXPECT_EQ(c.pairs.books().elastic_energy, 0.0) << "they have parted";
    }
}

TEST(GrainImpact, GrainsOfDifferentSize_BounceAsThePairOfReducedMass) {
  // xi is a fraction of the pair's critical damping, so e does not depend on the masses.
  const GrainLaw law{stiffness, 0.0, 0.1};
  SandState grains = make_grains({{0, 0, 0}, {3.1e-3, 0, 0}}, 1.5e-3, 2e-5);
  grains.grain_radius = {1e-3, 2e-3}, grains.grain_mass = {0.5e-5, 4e-5};
  grains.velocity = {{50, 0, 0}, {-50, 0, 0}};
  SandPairs pairs({law, {}, {}, 0, 1});
  pairs.forces(grains, 0.0);
  const double step = 0.2 * pairs.stable_step(), reduced = 0.5e-5 * 4e-5 / 4.5e-5;
  for (double t = 0.0; t < 2e-5; t += step) sand_step(grains, pairs, step);
  const double w0 = step * std::sqrt(stiffness / reduced), w = std::sqrt(1.0 - 0.01);
  const double expected = -0.1 / w * (std::numbers::pi - std::atan2(0.2 * w, w * w - 0.01));
  const double e = (grains.velocity[1].x - grains.velocity[0].x) / 100.0;
  EXPECT_NEAR(std::log(e), expected, 0.2 * w0 + 0.25 * w0 * w0);
}

TEST(GrainImpact, OnAMirrorPlane_BouncesAndGivesItsMomentumToThePlane) {
  SandState grains = make_grains({{1.2e-3, 5e-3, 0}}, radius, mass);
  grains.velocity = {{-40, 0, 7}};
  SandPairs pairs({{stiffness, 0.3, 0.0}, {true}, {}, 0, 1});
  pairs.forces(grains, 0.0);
  const double step = pairs.stable_step(), before = kinetic_energy(grains);
  for (double t = 0.0; t < 2e-5; t += step) sand_step(grains, pairs, step);
  EXPECT_NEAR(kinetic_energy(grains) / before, 1.0, 0.5 * w0_dt(step) * w0_dt(step));
  EXPECT_EQ(grains.velocity[0].z, 7.0) << "no friction on a plane of symmetry";
  EXPECT_NEAR(pairs.books().mirror_impulse.x, mass * (-40.0 - grains.velocity[0].x), 1e-15 * mass * 40 * 300);
}

TEST(GrainImpact, OnAMirrorPlaneWithChangingSteps_MomentumOfGrainAndPlaneIsKeptInEveryStep) {
  // Also in the middle of the contact: each force acts in one half kick before and one after it is known.
  SandState grains = make_grains({{1.05e-3, 5e-3, 0}}, radius, mass);
  grains.velocity = {{-40, 0, 0}};
  SandPairs pairs({{stiffness, 0.0, 0.1}, {true}, {}, 0, 1});
  pairs.forces(grains, 0.0);
  for (int n = 0; n < 60; ++n) {
    sand_step(grains, pairs, recommended_step(pairs.law(), mass) * (1.0 + 0.5 * (n % 3)));
    EXPECT_NEAR(mass * (grains.velocity[0].x + 40.0) + pairs.books().mirror_impulse.x, 0.0, 1e-15 * mass * 40 * 300)
        << "step " << n;
  }
  EXPECT_GT(grains.velocity[0].x, 20.0) << "it must have bounced";
}

TEST(GrainImpact, LoneGrainFromFarAway_IsFoundByTheOneItHits) {
  // Nothing moves against its neighbours until the last moment: only distance tells that the list is old.
  // In diameters; the third grain, so far behind, sets where cells begin: distances beyond cells, regions, bricks.
  for (const auto& [behind, distance] : {std::pair{2.2, 2.5}, {0.0, 5.0}, {0.0, 12.0}, {0.0, 60.0}}) {
    const double d = 2.0 * radius;
    SandState grains = make_grains({{0, 0, 0}, {d * distance, 0, 0}, {-d * behind, 6.0 * d, 0}}, radius, mass);
    grains.velocity[0] = {500, 0, 0};
    SandPairs pairs({{stiffness, 0.0, 0.0}, {}, {}, 0, 1});
    pairs.forces(grains, 0.0);
    const double step = recommended_step(pairs.law(), mass);
    for (double t = 0.0; t < 2.0 * radius * (distance + 3.0) / 500.0; t += step) sand_step(grains, pairs, step);
    EXPECT_NEAR(grains.velocity[1].x, 500.0, 500.0 * 0.5 * w0_dt(step) * w0_dt(step)) << distance << " diameters";
  }
}

}  // namespace
}  // namespace standoff::particles
