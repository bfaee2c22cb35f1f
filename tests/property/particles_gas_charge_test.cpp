// What the packed charge promises (packing/charge.hpp): counts, energy and momentum to rounding of sums of N terms
// (1e-13), no overlap at all, an isotropic body. Isotropy: for independent uniform points in a ball the centre of mass
// has the standard deviation R sqrt(1/5) / sqrt(N) along an axis and <x^2> = R^2/5 the relative one sqrt(25/... ) <
// 1/sqrt(N/2); the stratified packing must be within five of those, over which systematic anisotropy of a few percent
// would be seen.
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "particle_solver/packing/charge.hpp"
#include "tests/unit/particles_gas_scenes.hpp"

namespace standoff::particles {
namespace {

ChargeSpec c4(long particles, double fill, double gamma = 1.4) {
  ChargeSpec charge;
  charge.present = true;
  charge.explosive = {"c4", 1601.0, 8.7e9, gamma, fill, 8190.0};
  charge.mass = 0.150, charge.radius = 0.0282, charge.detonator = {0, 0, 0.1782}, charge.particles = particles;
  return charge;
}

double smallest_distance(const std::vector<Vec3>& position) {
  double smallest = 1e30;
  for (std::size_t i = 0; i < position.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) smallest = std::min(smallest, norm(position[i] - position[j]));
  return smallest;
}

class PackedCharge : public testing::TestWithParam<std::tuple<double, int>> {};

TEST_P(PackedCharge, AnyFill_HasItsParticlesEnergyAndNoOverlap) {
  const auto [fill, copies] = GetParam();
  const Vec3 centre{0, 0, 0.15};
  const GasState gas = build_charge(c4(8001, fill), centre, copies, 7);
  ASSERT_EQ(gas.size(), 8001u / static_cast<unsigned>(copies));
  const double n = static_cast<double>(gas.size()), energy = 0.150 / 1601.0 * 8.7e9 / copies;
  EXPECT_NEAR(gas.mass * n * copies, 0.150, 1e-13);
  EXPECT_NEAR(4.0 / 3.0 * 3.141592653589793 * std::pow(gas.radius, 3) * n * copies, fill * 0.150 / 1601.0, 1e-17);
  double kinetic = 0.0, internal = 0.0;
  Vec3 momentum;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    kinetic += 0.5 * gas.mass * squared_norm(gas.velocity[i]), internal += gas.internal_energy[i];
    momentum += gas.velocity[i] * gas.mass;
    EXPECT_LE(norm(gas.position[i] - centre), 0.0282 * (1 + 1e-12));
    if (copies == 4) {
      EXPECT_GE(std::min(gas.position[i].x, gas.position[i].y), 0.0);
    }
  }
  EXPECT_NEAR(kinetic, 0.6 * energy, 1e-13 * energy);
  EXPECT_NEAR(internal, 0.4 * energy, 1e-13 * energy);
  EXPECT_LT(norm(momentum), 1e-13 * test::momentum_scale(gas));
  EXPECT_GE(smallest_distance(gas.position), 2.0 * gas.radius);
}
INSTANTIATE_TEST_SUITE_P(FillsAndSymmetry, PackedCharge,
                         testing::Combine(testing::Values(0.05, 0.20, 0.35, 0.45), testing::Values(1, 4)));

TEST(PackedCharge_FullBall_IsIsotropicAndDependsOnTheSeed, Moments) {
  const double radius = 0.0282, n = 4000.0;
  const GasState gas = build_charge(c4(4000, 0.20), {}, 1, 1), other = build_charge(c4(4000, 0.20), {}, 1, 2);
  Vec3 mean, square;
  for (const Vec3& x : gas.position) mean += x / n, square += Vec3{x.x * x.x, x.y * x.y, x.z * x.z} / n;
  EXPECT_LT(norm(mean), 5.0 * radius * std::sqrt(0.6 / n));
  const double third = (square.x + square.y + square.z) / 3.0;
  EXPECT_NEAR(third, radius * radius / 5.0, 0.05 * third) << "fills the ball evenly";
  for (const double part : {square.x, square.y, square.z}) EXPECT_NEAR(part, third, 5.0 * third / std::sqrt(n / 2.0));
  EXPECT_NE(gas.position, other.position);
  EXPECT_NE(gas.velocity, other.velocity);
}

TEST(PackedCharge_GammaFiveThirds_HasNoReservoir, AllEnergyIsKinetic) {
  const GasState gas = build_charge(c4(400, 0.1, 5.0 / 3.0), {}, 1, 1);
  for (const double e : gas.internal_energy) EXPECT_EQ(e, 0.0);
}

TEST(PackedCharge_ImpossibleInput_StopsBeforeTheRun, NamesTheCause) {
  EXPECT_THROW(build_charge(c4(4000, 0.60), {}, 1, 1), Stop);
  EXPECT_THROW(build_charge(c4(4, 0.20), {}, 4, 1), Stop);
  EXPECT_THROW(build_charge(c4(4000, 0.20, 1.0), {}, 1, 1), Stop);
}

}  // namespace
}  // namespace standoff::particles
