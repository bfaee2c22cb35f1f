// What the step of the sand prevents: pairs of grains once more with a step that does not follow stiffness or dashpot.
// Law: kinetic and elastic energy and the booked losses add up. Bounds from the step: a contact is entered and left
// inside a step, which shifts energy by up to k (v dt)^2 / 8 = (w0 dt)^2 / 4 of the pair's; a dashpot acts
// with the speed of the step before, and its loss is booked for the way of that step: c dt / m_red of the pair's
// energy.
#include <gtest/gtest.h>

#include "particle_solver/step/sand_integrate.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

constexpr double radius = 1e-3, mass = 1e-5;

/// Largest error of the books of forty head-on hits over their energy, with the approach at any phase of a step.
double worst_error(const GrainLaw& law, double step) {
  double worst = 0.0;
  for (int i = 0; i < 40; ++i) {
    SandState grains = make_grains({{0, 0, 0}, {2.02 * radius + 100.0 * step * i / 40.0, 0, 0}}, radius, mass);
    grains.velocity = {{50, 0, 0}, {-50, 0, 0}};
    SandPairs pairs({law, {}, {}, 0, 1});
    pairs.forces(grains, 0.0);
    const double before = kinetic_energy(grains);
    for (double t = 0.0; t < 4e-5; t += step) {
      sand_step(grains, pairs, step);
      const SandBooks& b = pairs.books();
      worst = std::max(worst, std::abs(kinetic_energy(grains) + b.elastic_energy + b.damping_loss - before) / before);
    }
  }
  return worst;
}

TEST(GrainStep_ForGrainsTenTimesStiffer, OfTheSofterOnes_BreaksTheBooks) {
  const GrainLaw soft{1e7, 0.0, 0.0}, stiff{1e8, 0.0, 0.0};
  const double followed = worst_error(stiff, recommended_step(stiff, mass));
  const double kept = worst_error(stiff, recommended_step(soft, mass));
  EXPECT_LT(followed, 0.01);
  EXPECT_GT(kept, 0.04) << "energy error with the guard " << followed << ", without " << kept;
}

TEST(GrainStep_ForCriticalDamping, OfUndampedGrains_BreaksTheBooks) {
  const GrainLaw damped{1e7, 0.0, 1.0}, undamped{1e7, 0.0, 0.0};
  const double step = recommended_step(damped, mass);
  const double followed = worst_error(damped, step), kept = worst_error(damped, recommended_step(undamped, mass));
  const double share = 2.0 * step * std::sqrt(2.0 * damped.stiffness / mass);  // c dt / m_red
  EXPECT_LT(followed, share * (1.0 + share)) << "first order, and its square";
  EXPECT_GT(kept, 3.0 * followed) << "energy error with the guard " << followed << ", without " << kept;
}

TEST(GrainStep_AtTheDampingOfWetSand, IsThatOfUndampedGrains) {
  EXPECT_EQ(recommended_step({1e7, 0.0, 0.01}, mass), recommended_step({1e7, 0.0, 0.0}, mass));
}

}  // namespace
}  // namespace standoff::particles
