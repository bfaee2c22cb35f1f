// Closed forms of the gas kernels. Deterministic results are compared to a few units of rounding of the numbers that
// enter; means of N random draws within five standard errors sigma/sqrt(N), which a right kernel exceeds once in 2e6
// runs (and the draws are fixed by their seed).
#include <gtest/gtest.h>

#include "particle_solver/kernels/gas_impact_time.hpp"
#include "particle_solver/kernels/gas_pair_impulse.hpp"
#include "particle_solver/kernels/gas_release.hpp"
#include "particle_solver/kernels/larsen_borgnakke.hpp"

namespace standoff::particles {
namespace {

TEST(ImpactTime_HeadOnApproach, IsGapOverSpeed) {
  EXPECT_DOUBLE_EQ(impact_time({3, 0, 0}, {-2, 0, 0}, 1.0, 0.0, 5.0), 1.0);
  EXPECT_DOUBLE_EQ(impact_time({3, 0, 0}, {-2, 0, 0}, 1.0, 0.5, 5.0), 1.0);
  EXPECT_EQ(impact_time({3, 0, 0}, {-2, 0, 0}, 1.0, 0.0, 0.9), no_impact);
  EXPECT_EQ(impact_time({3, 0, 0}, {2, 0, 0}, 1.0, 0.0, 9.0), no_impact);
}

TEST(ImpactTime_SlowApproachFromAfar, HasNoCancellation) {
  // The textbook root (-b - sqrt(b^2-ac))/a loses eps b^2/(ac) here; the exact answer is 1e-9 s.
  const double gap = 1.0 + 1e-9;
  EXPECT_NEAR(impact_time({gap, 0, 0}, {-1, 0, 0}, 1.0, 0.0, 1.0), gap - 1.0, 1e-15);
}

TEST(ImpactTime_GrazingPath, IsAHitInsideAndNoneOutsideTheContactDistance) {
  EXPECT_EQ(impact_time({5, 1.0 + 1e-9, 0}, {-1, 0, 0}, 1.0, 0.0, 10.0), no_impact);
  EXPECT_EQ(impact_time({5, 1.0, 0}, {-1, 0, 0}, 1.0, 0.0, 10.0), no_impact);
  // y = 1 - e meets at x = sqrt(2 e): t = 5 - sqrt(2e - e^2); rounding of e itself (1e-16) moves it by 1e-16/sqrt(2e).
  EXPECT_NEAR(impact_time({5, 1.0 - 1e-8, 0}, {-1, 0, 0}, 1.0, 0.0, 10.0), 5.0 - std::sqrt(2e-8 - 1e-16), 1e-10);
}

TEST(ImpactTime_OverlappingPair, HitsNowIfItApproachesAndNeverIfItParts) {
  EXPECT_EQ(impact_time({0.5, 0, 0}, {-1, 0, 0}, 1.0, 0.25, 1.0), 0.25);
  EXPECT_EQ(impact_time({0.5, 0, 0}, {1, 0, 0}, 1.0, 0.0, 1.0), no_impact);
  EXPECT_EQ(impact_time({0.5, 0, 0}, {0, 0, 0}, 1.0, 0.0, 1.0), no_impact);
}

TEST(PairImpulse_ElasticWithUnequalMasses, KeepsMomentumAndEnergy) {
  const double m_i = 2.0, m_j = 7.0;
  const Vec3 n = line_of_centres({1, 2, 2}, {}), v_i{3, -1, 2}, v_j{-4, 0, 1};
  const double before = dot(v_j - v_i, n), impulse = pair_impulse(reduced_mass(1 / m_i, 1 / m_j), before, -before);
  const Vec3 a = v_i - n * (impulse / m_i), b = v_j + n * (impulse / m_j);
  EXPECT_NEAR(dot(b - a, n), -before, 1e-14);
  EXPECT_NEAR(norm(a * m_i + b * m_j - v_i * m_i - v_j * m_j), 0.0, 1e-14);
  const double old_energy = m_i * squared_norm(v_i) + m_j * squared_norm(v_j);
  EXPECT_NEAR(m_i * squared_norm(a) + m_j * squared_norm(b), old_energy, 1e-15 * old_energy * 8);
}

class Exchange : public testing::TestWithParam<double> {};

TEST_P(Exchange, AnyGamma_KeepsEnergyAndHasTheMomentsOfTheBetaLaws) {
  // E_n'/E ~ Beta(1, zeta): mean 1/(1+zeta), variance zeta/((1+zeta)^2 (2+zeta)).
  // B ~ Beta(a, a), a = zeta/2: mean 1/2, variance 1/(4(2a+1)), so E(B-1/2)^2 is that with variance at most 1/16.
  const double zeta = internal_degrees_of_freedom(GetParam()), mu = 0.3, total = 0.5 * mu * 4.0 + 1.5 + 0.7;
  const int draws = 40000;
  double share = 0.0, middle = 0.0, spread = 0.0;
  int splits = 0;  // for a small zeta the rest is often zero to rounding, and there is nothing to split
  for (int k = 0; k < draws; ++k) {
    CounterRandom random(5, RandomUse::test, static_cast<std::uint32_t>(k));
    const EnergyExchange after = larsen_borgnakke(mu, -2.0, 1.5, 0.7, zeta, random);
    const double normal = 0.5 * mu * after.normal_velocity * after.normal_velocity;
    ASSERT_NEAR(normal + after.energy_i + after.energy_j, total, 1e-15 * total * 4);
    ASSERT_GT(after.normal_velocity, 0.0);
    ASSERT_GE(std::min(after.energy_i, after.energy_j), 0.0);
    share += normal / total;
    if (after.energy_i + after.energy_j == 0.0) continue;
    const double part = after.energy_i / (after.energy_i + after.energy_j);
    middle += part, spread += (part - 0.5) * (part - 0.5), ++splits;
  }
  const double variance = zeta / ((1 + zeta) * (1 + zeta) * (2 + zeta)), split = 0.25 / (zeta + 1.0);
  EXPECT_NEAR(share / draws, 1.0 / (1.0 + zeta), 5.0 * std::sqrt(variance / draws));
  ASSERT_GT(splits, draws / 2);
  EXPECT_NEAR(middle / splits, 0.5, 5.0 * std::sqrt(split / splits));
  EXPECT_NEAR(spread / splits, split, 5.0 * 0.25 / std::sqrt(splits));
}
// zeta = 0.03, 0.33, 0.85, 1, 2 (the explosive), 5.7, 37: every branch of the Beta variate.
INSTANTIATE_TEST_SUITE_P(Gammas, Exchange, testing::Values(1.66, 1.6, 1.52, 1.5, 1.4, 1.23, 1.05));

TEST(Release_AfterHits, KeepsEnergyAndGivesTheImpulseBack) {
  const double mass = 2e-5, energy = 40.0;
  const Vec3 velocity{1000, -500, 200}, impulse{0.01, 0.02, -0.004};
  const Release loose = release(mass, velocity, energy, impulse);
  EXPECT_LT(norm(loose.velocity * mass - velocity * mass - impulse), 1e-17);
  const double old_total = 0.5 * mass * squared_norm(velocity) + energy;
  EXPECT_NEAR(0.5 * mass * squared_norm(loose.velocity) + loose.internal_energy, old_total, 1e-15 * old_total * 4);
  EXPECT_EQ(norm(loose.handed_on), 0.0);
}

TEST(Release_StruckHarderThanItCanCarry_SpendsAllItsEnergyAndHandsTheRestOn, SameDirection) {
  const double mass = 2e-5, energy = 40.0;
  const Vec3 velocity{1000, -500, 200}, impulse{0.1, 0.2, -0.04};
  const Release loose = release(mass, velocity, energy, impulse);
  const double total = 0.5 * mass * squared_norm(velocity) + energy;
  const Vec3 wanted = velocity * mass + impulse;
  EXPECT_LT(norm(loose.velocity * mass + loose.handed_on - wanted), 1e-15 * norm(wanted));
  EXPECT_NEAR(0.5 * mass * squared_norm(loose.velocity) + loose.internal_energy, total, 1e-15 * total * 4);
  EXPECT_NEAR(loose.internal_energy, 0.0, 1e-15 * total * 4);
  EXPECT_LT(norm(cross(loose.velocity, wanted)), 1e-15 * norm(loose.velocity) * norm(wanted) * 4);
}

}  // namespace
}  // namespace standoff::particles
