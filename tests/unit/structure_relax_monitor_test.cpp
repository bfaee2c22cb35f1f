// What counts as rest: kinetic energy, centre drift and plastic work over one whole period, each measured. The signals
// are closed forms, the limits of the contract (1e-9, 2 um, 1e-6), so each case is far on one side of its limit.
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "structure_solver/relaxation/rest_monitor.hpp"

namespace standoff::structure {
namespace {

constexpr double period = 2e-3, peak = 1000.0;  // s, J

struct Signal {
  std::function<double(double)> deflection = [](double) { return 0.02; };
  std::function<double(double)> kinetic = [](double) { return 0.0; };
  std::function<double(double)> plastic = [](double) { return 500.0; };
};

RestMonitor after(double duration, const Signal& signal, double step = period / 200.0) {
  RestMonitor monitor(RestLimits{}, period, peak);
  for (int i = 0; i * step <= duration * (1.0 + 1e-12); ++i)
    monitor.observe(i * step, signal.deflection(i * step), signal.kinetic(i * step), signal.plastic(i * step));
  return monitor;
}

TEST(RestMonitor, NothingMoves_RestOnlyAfterOnePeriod) {
  EXPECT_FALSE(after(0.9 * period, {}).quiet());
  EXPECT_TRUE(after(1.1 * period, {}).quiet());
  EXPECT_TRUE(after(1.1 * period, {}, period / 16.0).quiet()) << "long steps are watched like short ones";
}

// An undamped swing of 1 um has its kinetic energy at zero here; the envelope of 1e-3 J counts.
TEST(RestMonitor, TurningPoint_IsNotRest) {
  Signal swing;
  swing.kinetic = [](double t) { return 1e-3 * std::pow(std::sin(2.0 * std::numbers::pi * t / period), 2); };
  const RestMonitor monitor = after(2.0 * period, swing);
  EXPECT_GE(monitor.kinetic_ratio(), 0.5e-6);
  EXPECT_FALSE(monitor.quiet());
}

// An overdamped mode: 10 um per period with no kinetic energy to speak of.
TEST(RestMonitor, SlowCreep_IsNotRest) {
  Signal creep;
  creep.deflection = [](double t) { return 0.02 + 1e-5 * t / period; };
  const RestMonitor monitor = after(3.0 * period, creep);
  EXPECT_NEAR(monitor.drift(), 1e-5, 0.05e-5) << "m per period";
  EXPECT_FALSE(monitor.quiet());
  EXPECT_NE(monitor.shortcomings(0.0).find("centre moved"), std::string::npos);
}

TEST(RestMonitor, PlasticWorkGrowsInOneStep_IsNotRestForOnePeriod) {
  Signal flow;
  flow.plastic = [](double t) { return t < 2.0 * period ? 500.0 : 500.0 + 5e-3; };  // 1e-5 of the total
  EXPECT_FALSE(after(2.9 * period, flow).quiet());
  EXPECT_TRUE(after(3.2 * period, flow).quiet());
  EXPECT_FALSE(after(2.5 * period, flow, period / 16.0).quiet());
}

TEST(RestMonitor, ForceOutOfBalance_IsNamedWithItsSize) {
  const RestMonitor monitor = after(1.1 * period, {});
  EXPECT_EQ(monitor.shortcomings(0.5), "");
  EXPECT_NE(monitor.shortcomings(12.5).find("12.5 N"), std::string::npos) << monitor.shortcomings(12.5);
}

TEST(RestMonitor, WatchedAgain_RestMustBeShownAnew) {
  RestMonitor monitor = after(1.1 * period, {});
  monitor.restart(period);
  monitor.observe(1.2 * period, 0.02, 0.0, 500.0);
  EXPECT_FALSE(monitor.quiet());
}

}  // namespace
}  // namespace standoff::structure
