// A chain of n equal masses m and springs k, one end held, the other free, vibrates at
//   omega_j = 2 sqrt(k/m) sin((2 j - 1) pi / (2 (2 n + 1))),  j = 1 .. n
// (Thomson, Theory of Vibration, lumped chain). The lowest eigenvalue is iterated to 1e-5, so the frequency is good to
// 1e-4; the highest comes from below within its 5 % margin. Solves: n = 40 and a condition of 1e3, so 1e-12 is
// rounding.
#include <numbers>

#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "structure_solver/relaxation/vibration.hpp"
#include "tests/unit/structure_relax_mocks.hpp"

namespace standoff::structure {
namespace {

constexpr int n = 40;
constexpr double m = 0.2, k = 5e6;

test::SpringChain chain() {
  return {std::vector<double>(n, m), std::vector<test::Spring>(n, test::Spring{k})};
}

StiffnessFactor factor_of(test::SpringChain& c) {
  return {c.stiffness(c.u), c.mass()};
}

double omega(int j) {
  return 2.0 * std::sqrt(k / m) * std::sin((2 * j - 1) * std::numbers::pi / (2 * (2 * n + 1)));
}

TEST(Vibration, UniformChain_FrequenciesOfClosedForm) {
  test::SpringChain c = chain();
  StiffnessFactor stiffness = factor_of(c);
  const LowestMode mode = lowest_mode(stiffness, c.v);
  EXPECT_NEAR(mode.angular_frequency, omega(1), 1e-4 * omega(1)) << "rad/s";
  EXPECT_EQ(mode.negative_modes, 0);
  EXPECT_EQ(mode.shift, 0.0);
  const double highest = highest_frequency(stiffness);
  EXPECT_GE(highest, omega(n)) << "a stable step must not come out too long";
  EXPECT_LE(highest, 1.06 * omega(n));
}

// K - s M with omega_2^2 < s < omega_3^2 has two negative eigenvalues; the lowest positive one is omega_3^2 - s.
TEST(Vibration, IndefiniteStiffness_CountsNegativeModesAndFindsLowestPositive) {
  test::SpringChain c = chain();
  const double s = 0.5 * (omega(2) * omega(2) + omega(3) * omega(3));
  c.stiffness_error = -s * m;
  StiffnessFactor stiffness = factor_of(c);
  const LowestMode mode = lowest_mode(stiffness, c.v);
  const double expected = std::sqrt(omega(3) * omega(3) - s);
  EXPECT_EQ(mode.negative_modes, 2);
  EXPECT_GT(mode.shift, s - omega(1) * omega(1));
  EXPECT_NEAR(mode.angular_frequency, expected, 1e-3 * expected) << "rad/s";
}

TEST(Vibration, OneDegreeOfFreedom_IsItsOwnMode) {
  test::SpringChain c({m}, {test::Spring{k}});
  StiffnessFactor stiffness = factor_of(c);
  EXPECT_NEAR(lowest_mode(stiffness, c.v).angular_frequency, std::sqrt(k / m), 1e-10 * std::sqrt(k / m));
}

TEST(StiffnessFactor, CombinationOfStiffnessAndMass_SolvesIt) {
  test::SpringChain c = chain();
  StiffnessFactor stiffness = factor_of(c);
  const double a = 3e-7, b = 1.7;
  stiffness.factor(a, b);
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0), kx(n), solution(n);
  stiffness.multiply(x, kx);
  const Eigen::VectorXd right = a * kx + b * m * x;
  stiffness.solve({right.data(), n}, {solution.data(), n});
  EXPECT_LT((solution - x).lpNorm<Eigen::Infinity>(), 1e-12);
}

TEST(StiffnessFactor, NotANumberInStiffness_StopsWithReason) {
  test::SpringChain c = chain();
  c.stiffness_error = std::numeric_limits<double>::quiet_NaN();
  StiffnessFactor stiffness = factor_of(c);
  EXPECT_THROW(stiffness.factor(1.0, 0.0), Stop);
}

}  // namespace
}  // namespace standoff::structure
