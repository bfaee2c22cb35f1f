// Law: the integer window is the clock, nothing is lost, and every value arrives as it was sent. With H the window,
//   parallel  load(k-1) acts on the structure in window k, motion(k-1) on the load side; one drain window at the end
//   serial    load(k) acts on the structure in window k, motion(k-1) on the load side; no drain
// Values are small integers times powers of two, so every comparison is exact. The impulses given and received are sums
// of the same numbers in the same order: equal to the last bit.
#include <gtest/gtest.h>

#include "tests/contract/coupling_counting.hpp"

namespace standoff::test {
namespace {

class Exchange : public testing::TestWithParam<std::tuple<bool, const char*>> {};

TEST_P(Exchange, TwoHundredWindows_EveryValueArrivesInOrder) {
  CoupledRun run;
  run.broker.rules.parallel = std::get<0>(GetParam());
  if (*std::get<1>(GetParam())) run.broker.listen = std::get<1>(GetParam());
  Child broker = run.start_broker();
  Child load = run.start(run.options(Role::load), count_load);
  Child structure = run.start(run.options(Role::structure), count_structure);
  EXPECT_EQ(load.wait(), 0) << run.errors("particles");
  EXPECT_EQ(structure.wait(), 0) << run.errors("structure");
  EXPECT_EQ(broker.wait(), 0) << run.errors("broker");

  const auto ledger = run.events("interface");
  ASSERT_EQ(ledger.size(), 1u);
  EXPECT_EQ(ledger[0]["impulse_given_Ns"], ledger[0]["impulse_received_Ns"]);
  EXPECT_GT(ledger[0]["impulse_given_Ns"][2].get<double>(), 1.0);
  EXPECT_EQ(run.events("joined").size(), 2u);
  EXPECT_EQ(run.events("clock").at(0)["windows"], counted_windows);
  EXPECT_EQ(run.events("sample").at(0)["values"]["centre_deflection_m"], 0.0);
  EXPECT_EQ(run.events("report").size(), 2u);
  const auto progress = run.events("progress");
  ASSERT_FALSE(progress.empty());  // at most ten a second, the last is never lost
  EXPECT_EQ(progress.back()["values"]["kinetic_J"], counted_windows - 1);
  EXPECT_EQ(progress.back()["values"]["windows"], counted_windows);
  EXPECT_EQ(run.events("done").size(), 1u);
  for (const char* left : {"/broker", "/broker.lock"}) EXPECT_FALSE(std::filesystem::exists(run.folder + left)) << left;
}

INSTANTIATE_TEST_SUITE_P(Coupling, Exchange,
                         testing::Combine(testing::Bool(), testing::Values("", "tcp://127.0.0.1:*")));

TEST(EarlyStop, StopAskedFor_BothSidesEndAtTheSameWindow) {
  CoupledRun run;
  Child broker = run.start_broker();
  Child load = run.start(run.options(Role::load), [](Participant& link) {
    idle_load(link, [&](std::int64_t k) {
      require(k <= 20, "went on after the end");
      if (k == 20) link.request_stop("nothing moves any more");
    });
  });
  Child structure = run.start(run.options(Role::structure), [](Participant& link) {
    idle_structure(link, [](std::int64_t k) { require(k <= 21, "went on after the drain"); });
  });
  EXPECT_EQ(load.wait(), 0) << run.errors("particles");
  EXPECT_EQ(structure.wait(), 0) << run.errors("structure");
  EXPECT_EQ(broker.wait(), 0) << run.errors("broker");
  EXPECT_EQ(run.events("stopping").at(0)["windows"], 21);
}

// A job that is stopped and continued as a whole (Ctrl-Z, a sleeping laptop) has missed every beat, by nobody's fault.
TEST(PausedRun, AllStoppedForLongerThanTheBeatDeadline_GoesOnWhenContinued) {
  CoupledRun run;
  run.broker.rules.deadlines.beat = 1.2;
  run.broker.rules.deadlines.beat_interval = 0.2;
  const auto slowly = [](std::int64_t) { std::this_thread::sleep_for(std::chrono::milliseconds(3)); };
  Child broker = run.start_broker();
  Child load = run.start(run.options(Role::load), [&](Participant& link) {
    idle_load(link, [&](std::int64_t k) { slowly(k), link.progress({}); });
  });
  Child structure = run.start(run.options(Role::structure), [&](Participant& link) { idle_structure(link, slowly); });
  ASSERT_TRUE(eventually(10.0, [&] { return !run.events("progress").empty(); }));
  for (Child* child : {&broker, &load, &structure}) child->signal(SIGSTOP);
  std::this_thread::sleep_for(std::chrono::milliseconds(2200));
  for (Child* child : {&broker, &load, &structure}) child->signal(SIGCONT);
  EXPECT_EQ(load.wait(), 0) << run.errors("particles");
  EXPECT_EQ(structure.wait(), 0) << run.errors("structure");
  EXPECT_EQ(broker.wait(), 0) << run.errors("broker");
}

}  // namespace
}  // namespace standoff::test
