// Law: whoever dies, freezes, sticks or stops, everyone else is gone within ten seconds, with the exit code of the
// first failure, and all print the same first cause. The deadlines of the session are shortened where a test waits for
// one; the ten seconds are the promise of the contract, not a measurement.
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

TEST_F(Death, ParticlesKilled_EveryoneGoneWithTheSameFirstCause) {
  start_all();
  particles->signal(SIGKILL);
  expect_all_gone(4, "particles, window", {"broker", "structure"});
  EXPECT_EQ(run.events("failed").at(0)["origin"], "particles");
  EXPECT_EQ(run.events("failed").at(0)["code"], 4);
  EXPECT_FALSE(std::filesystem::exists(run.folder + "/broker"));
  EXPECT_FALSE(std::filesystem::exists(run.folder + "/broker.lock"));
}

TEST_F(Death, StructureKilled_EveryoneGoneWithTheSameFirstCause) {
  start_all();
  plate->signal(SIGKILL);
  expect_all_gone(4, "structure, window", {"broker", "particles"});
  EXPECT_EQ(run.events("failed").at(0)["origin"], "structure");
}

TEST_F(Death, BrokerKilled_EveryoneGoneAndItsPathCanBeUsedAgain) {
  start_all();
  broker->signal(SIGKILL);
  broker->wait();
  expect_all_gone(4, "first cause: broker: the process ended without a goodbye", {"particles", "structure"});
  Child second = run.start_broker();
  EXPECT_EQ(run.events("listening").size(), 1u) << run.errors("broker");
}

TEST_F(Death, SolverBusyForLongWhenItsPartnerDies_ItsProcessEnds) {
  start_all(follow_load, [](Participant& link) {
    idle_structure(link, [](std::int64_t k) { std::this_thread::sleep_for(std::chrono::seconds(k == 2 ? 60 : 0)); });
  });
  particles->signal(SIGKILL);
  expect_all_gone(4, "particles, window", {"broker", "structure"});
}

TEST_F(Death, ParticlesFrozen_FoundByTheirSilence) {
  run.broker.rules.deadlines.beat = 1.5;
  run.broker.rules.deadlines.beat_interval = 0.1;
  start_all();
  particles->signal(SIGSTOP);
  expect_all_gone(4, "no sign of life for 1.5 s: particles", {"broker", "structure"});
}

TEST_F(Death, BrokerFrozen_FoundByItsSilence) {
  run.broker.rules.deadlines.beat = 1.5;
  run.broker.rules.deadlines.beat_interval = 0.1;
  start_all();
  broker->signal(SIGSTOP);
  expect_all_gone(4, "first cause: broker: no sign of life for 1.5 s", {"particles", "structure"});
}

TEST_F(Death, SolverStuckWhileItsProcessLives_FoundByItsProgress) {
  run.broker.rules.deadlines.progress = 0.5;
  run.broker.rules.deadlines.beat_interval = 0.1;
  start_all(follow_load, [](Participant& link) {
    idle_structure(link, [](std::int64_t k) { std::this_thread::sleep_for(std::chrono::seconds(k == 2 ? 60 : 0)); });
  });
  expect_all_gone(4, "structure, window 2: no progress for 0.5 s", {"broker", "particles", "structure"});
}

TEST_F(Death, GuardStopsTheLoadSide_ItsCodeAndReasonReachEveryone) {
  start_all([](Participant& link) {
    idle_load(link, [&](std::int64_t k) {
      link.progress({});
      pause(k);
      if (k == 30) throw Stop(ExitCode::guard, "energy has grown by 12 %: use a smaller step");
    });
  });
  expect_all_gone(3, "energy has grown by 12 %: use a smaller step", {"broker", "structure"});
  EXPECT_EQ(particles->wait(), 3);
  EXPECT_NE(run.errors("particles").find("energy has grown"), std::string::npos);
}

TEST_F(Death, InterruptOfAnyProcess_EveryoneEndsWith130) {
  start_all();
  plate->signal(SIGINT);
  expect_all_gone(130, "interrupted by SIGINT", {"broker", "particles", "structure"});
}

TEST_F(Death, BrokerTerminated_EveryoneEndsWith130) {
  start_all();
  broker->signal(SIGTERM);
  expect_all_gone(130, "first cause: broker: interrupted by SIGTERM", {"broker", "particles", "structure"});
  EXPECT_FALSE(std::filesystem::exists(run.folder + "/broker"));
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
