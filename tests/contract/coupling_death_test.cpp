// Law: whoever dies, freezes, sticks or stops, everyone else is gone within ten seconds, with the exit code of the
// first failure, and all print the same first cause. The deadlines of the session are shortened where a test waits for
// one; the ten seconds are the promise of the contract, not a measurement. Most faults are lines of faults.csv; here is
// what needs a scene of its own.
#include <gtest/gtest.h>

#include "tests/contract/coupling_harness.hpp"

namespace standoff::test {
namespace {

class Death : public testing::Test {
 protected:
  Death() {
    run.broker.rules.window = {WindowRule::Kind::fixed, 1e-6};  // a million windows: never over by itself
  }
  static void pause(std::int64_t) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }
  static void follow_load(Participant& link) {
    idle_load(link, [&](std::int64_t k) {
      pause(k);
      link.progress({});
    });
  }
  void start_all(
      const std::function<void(Participant&)>& load = follow_load,
      const std::function<void(Participant&)>& structure = [](Participant& link) { idle_structure(link, pause); }) {
    broker.emplace(run.start_broker());
    particles.emplace(run.start(run.options(Role::load), load));
    plate.emplace(run.start(run.options(Role::structure), structure));
    ASSERT_TRUE(eventually(10.0, [&] { return !run.events("progress").empty(); })) << run.errors("structure");
  }
  void expect_all_gone(int code, const std::string& cause, const std::vector<std::string>& survivors) {
    for (const std::string& name : survivors) {
      Child& child = name == "broker" ? *broker : name == "particles" ? *particles : *plate;
      EXPECT_EQ(child.wait(10.0), code) << name << ": " << run.errors(name);
      EXPECT_EQ(run.cause(name), run.cause(survivors[0])) << name;
    }
    EXPECT_NE(run.cause(survivors[0]).find(cause), std::string::npos) << run.cause(survivors[0]);
  }
  CoupledRun run;
  std::optional<Child> broker, particles, plate;
};

TEST_F(Death, SolverBusyForLongWhenItsPartnerDies_ItsProcessEnds) {
  start_all(follow_load, [](Participant& link) {
    idle_structure(link, [](std::int64_t k) { std::this_thread::sleep_for(std::chrono::seconds(k == 2 ? 60 : 0)); });
  });
  particles->signal(SIGKILL);
  expect_all_gone(4, "particles, window", {"broker", "structure"});
}

TEST_F(Death, InterruptOfOneWhereNobodyCanSave_EveryoneEndsWith130) {
  start_all();
  plate->signal(SIGINT);
  expect_all_gone(130, "interrupted by SIGINT", {"broker", "particles", "structure"});
}

TEST_F(Death, LauncherKilled_BrokerEnds) {
  // Three generations: this test, a launcher that is killed, and the broker it started.
  Child launcher(run.error_file("launcher"), [&] {
    if (fork() == 0) {
      alarm(20);
      std::ofstream events(run.folder + "/events");
      run.broker.print = [&](const std::string& line) { events << line << std::endl; };
      watch_process();
      _exit(run_broker(run.broker));
    }
    std::this_thread::sleep_for(std::chrono::seconds(20));
    return 0;
  });
  ASSERT_TRUE(eventually(10.0, [&] { return !run.events("listening").empty(); }));
  launcher.signal(SIGKILL);
  EXPECT_TRUE(eventually(10.0, [&] { return !std::filesystem::exists(run.folder + "/broker.lock"); }));
  EXPECT_EQ(run.events("failed").at(0)["reason"], "the program that started this process has ended");
}

}  // namespace
}  // namespace standoff::test
