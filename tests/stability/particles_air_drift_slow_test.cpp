// A hundred thousand steps of ambient air, every cell awake: nothing may drift. Still air beyond an open box sends its
// half-Maxwellian and takes what flies out; N particles then have the standard deviation sqrt(N), k independent states
// sqrt(N / k), and the energy of a particle sqrt(2 / (3 n)) of itself over n free particles (Bird, Molecular Gas
// Dynamics, 1994, 4.22). The box renews itself in a side over the thermal speed. Each tenth of the run is judged
// against the mean of all, within four standard deviations: a drift of 0.03 % of the number per thousand steps would
// show.
#include <gtest/gtest.h>

#include "tests/unit/particles_air_scenes.hpp"

namespace standoff::particles {
namespace {

TEST(AmbientAir, ForAHundredThousandSteps_DoesNotDrift) {
  const AirBox box{{-0.025, -0.025, -0.025}, {0.025, 0.025, 0.025}, 0.0125, 4.0};
  const auto air = air_in(box);
  AirLoop loop(*air, nullptr, Boundaries({box.lower, box.upper, false, 1}));
  loop.wake_everything();
  const double s = air->ambient.thermal_speed(), dt = 0.2 * box.cell / s, renewals = 1e4 * dt * s / 0.05;
  std::vector<double> number(10), kinetic(10);
  for (std::size_t tenth = 0; tenth < 10; ++tenth)
    for (int i = 0; i < 10000; ++i) {
      loop.step(dt);
      number[tenth] += 1e-4 * static_cast<double>(air->particles.size());
      for (const Vec3& v : air->particles.velocity) kinetic[tenth] += 0.5e-4 * air->particles.mass * squared_norm(v);
    }
  double mean_number = 0.0, mean_kinetic = 0.0;
  for (std::size_t k = 0; k < 10; ++k) mean_number += 0.1 * number[k], mean_kinetic += 0.1 * kinetic[k] / number[k];
  const double expected = 64.0 * box.particles_a_cell, free_particles = 10.0 * renewals * expected;
  EXPECT_NEAR(mean_number, expected, 4.0 * std::sqrt(expected / (10.0 * renewals))) << "particles";
  EXPECT_NEAR(mean_kinetic / (1.5 * air->particles.mass * s * s), 1.0, 4.0 * std::sqrt(2.0 / (3.0 * free_particles)))
      << "energy of a particle";
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR(number[k], mean_number, 4.0 * std::sqrt(mean_number / renewals)) << "particles, tenth " << k;
    EXPECT_NEAR(kinetic[k] / number[k] / mean_kinetic, 1.0, 4.0 * std::sqrt(2.0 / (3.0 * renewals * mean_number)))
        << "energy of a particle, tenth " << k;
  }
}

}  // namespace
}  // namespace standoff::particles
