// What the relaxation does when CVODE cannot go on: restarts, then the explicit leapfrog, and every time it says so.
// The forces fail on purpose; wherever the detour leads, elastic springs must return to zero: |u| < 1 N / (k / n) after
// the motion, much less after the static solve (1e-3 N / (k / n) = 3e-9 m).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "structure_solver/relaxation/relaxation.hpp"
#include "tests/unit/structure_relax_mocks.hpp"

namespace standoff::structure {
namespace {

using ::testing::HasSubstr;
constexpr std::size_t n = 6;
constexpr double k = 2e6;

struct Failing : test::SpringChain {
  Failing() : SpringChain(std::vector<double>(n, 0.1), std::vector<test::Spring>(n, test::Spring{k})) {
    for (std::size_t i = 0; i < n; ++i) v[i] = 2.0 * static_cast<double>(i + 1);
  }
  bool internal_force(std::span<const double> at, double dt, std::span<double> f) override {
    const bool ok = SpringChain::internal_force(at, dt, f);
    if (dt > longest_dt && commits >= 20) return false;
    if (forces >= fail_from && forces < fail_to) return not_finite ? (f[0] = std::nan(""), true) : false;
    return ok;
  }
  long fail_from = 0, fail_to = 0;  // calls that find an inverted element
  double longest_dt = 1e300;        // s, after 20 steps
  bool not_finite = false;
};

RelaxationResult relax(Failing& chain, RelaxationOptions options = {}) {
  options.peak_kinetic_energy = chain.kinetic();
  options.time_cap = 0.3;
  return relax_to_rest(chain, options);
}

void expect_at_zero(const Failing& chain, const RelaxationResult& result) {
  EXPECT_TRUE(result.at_rest) << result.message;
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(chain.u[i], 0.0, 3e-9) << "m, mass " << i << ": " << result.message;
}

TEST(RelaxationRecovery, ForceFailsOnce_StepIsShortened) {
  for (const bool not_finite : {false, true}) {
    Failing chain;
    chain.fail_from = 50, chain.fail_to = 52;
    chain.not_finite = not_finite;
    expect_at_zero(chain, relax(chain));
  }
}

TEST(RelaxationRecovery, ForceFailsAtEveryStepSize_RestartsFromTheLastAcceptedState) {
  Failing chain;
  chain.fail_from = 50, chain.fail_to = 66;  // the first try and the 15 shorter ones that CVODE is allowed
  const RelaxationResult result = relax(chain);
  expect_at_zero(chain, result);
  EXPECT_THAT(result.message, HasSubstr("CV_"));
  EXPECT_THAT(result.message, HasSubstr("restarting with a shorter step"));
  EXPECT_EQ(chain.commits, result.steps);
}

TEST(RelaxationRecovery, OnlyTinyStepsPossible_GoesOnExplicitly) {
  Failing chain;
  chain.longest_dt = 5e-6;
  RelaxationOptions options;
  options.explicit_step = 4e-6;
  const RelaxationResult result = relax(chain, options);
  expect_at_zero(chain, result);
  EXPECT_THAT(result.message, HasSubstr("shorter than the explicit"));
  EXPECT_THAT(result.message, HasSubstr("explicit damped leapfrog"));
}

TEST(RelaxationRecovery, NoForceAnyMore_StopsWithReason) {
  Failing chain;
  chain.fail_from = 50, chain.fail_to = 1000000000;
  try {
    relax(chain);
    FAIL() << "no exception";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::guard);
    EXPECT_THAT(stop.what(), HasSubstr("no force at the starting state"));
  }
}

TEST(RelaxationRecovery, NoForceAtTheStart_StopsWithReason) {
  Failing chain;
  chain.fail_from = 1, chain.fail_to = 1000000000;
  EXPECT_THROW(relax(chain), Stop);
}

// A tenth above the stability limit: the energy guard must end it, not a wrong answer.
TEST(RelaxationRecovery, LeapfrogUnstable_EnergyGuardStops) {
  Failing chain;
  RelaxationOptions options;
  options.method = RelaxationMethod::explicit_leapfrog;
  options.explicit_step = 1.1 * 2.0 / (2.0 * std::sqrt(k / 0.1));
  try {
    relax(chain, options);
    FAIL() << "no exception";
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::guard);
    EXPECT_THAT(stop.what(), HasSubstr("energy grows"));
  }
}

}  // namespace
}  // namespace standoff::structure
