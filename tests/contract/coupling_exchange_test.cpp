// Law: the integer window is the clock, nothing is lost, and every value arrives as it was sent. With H the window,
//   parallel  load(k-1) acts on the structure in window k, motion(k-1) on the load side; one drain window at the end
//   serial    load(k) acts on the structure in window k, motion(k-1) on the load side; no drain
// Values are small integers times powers of two, so every comparison is exact. The impulses given and received are sums
// of the same numbers in the same order: equal to the last bit.
#include <gtest/gtest.h>

#include "tests/contract/coupling_harness.hpp"

namespace standoff::test {
namespace {

constexpr std::int64_t windows = 200;

Vec3 force_of(std::int64_t k, std::size_t node) {
  return {0.25 * static_cast<double>(k), -1.0, static_cast<double>(k + 1) * static_cast<double>(node + 1)};
}
Vec3 motion_of(std::int64_t k, std::size_t node) {
  return {static_cast<double>(node), 0.5 * static_cast<double>(k + 1), static_cast<double>(-k)};
}

void require(bool truth, const std::string& what) {
  if (!truth) throw Stop(ExitCode::check_failed, what);
}

void count_load(Participant& link) {
  const SurfaceMesh mesh = link.receive_surface();
  const std::size_t nodes = mesh.position.size();
  require(mesh.position == strip(3).position && mesh.node_mass == strip(3).node_mass, "the surface has changed");
  const CouplingClock clock = link.ready({0.001, 0.0});
  require(clock.windows == windows && clock.window == 1.0 / windows, "the clock is not until / windows");
  InterfaceTotals totals;
  std::int64_t expected = 0;
  while (const auto grant = link.next()) {
    const std::int64_t k = grant->window;
    require(k == expected++ && grant->begin == static_cast<double>(k) * clock.window && !grant->drain, "wrong window");
    SurfaceLoad load;
    for (std::size_t i = 0; i < nodes; ++i) {
      const Vec3 wanted = k == 0 ? mesh.position[i] : motion_of(k - 1, i);
      require(grant->motion.position[i] == wanted, "wrong position in window " + std::to_string(k));
      require(grant->motion.velocity[i] == (k == 0 ? Vec3{} : -wanted),
              "wrong velocity in window " + std::to_string(k));
      load.force.push_back(force_of(k, i));
      totals.impulse += force_of(k, i) * clock.window;
    }
    link.progress({{"kinetic_J", static_cast<double>(k)}});
    link.advance(load, totals);
  }
  require(expected == windows, "windows are missing");
  link.finish(R"({"results": {"impulse_Ns": 1.5}})");
}

void count_structure(Participant& link) {
  const std::size_t nodes = strip(3).position.size();
  link.offer_surface(strip(3));
  const CouplingClock clock = link.ready({0.005, 0.0});
  link.sample(0.0, {{"centre_deflection_m", 0.0}});
  InterfaceTotals totals;
  std::int64_t expected = 0;
  while (const auto grant = link.next()) {
    const std::int64_t k = grant->window, of = clock.parallel ? k - 1 : k;
    require(k == expected++ && grant->drain == (k == windows), "wrong window");
    SurfaceMotion motion;
    for (std::size_t i = 0; i < nodes; ++i) {
      require(grant->load.force[i] == (of < 0 ? Vec3{} : force_of(of, i)),
              "wrong force in window " + std::to_string(k));
      totals.impulse += grant->load.force[i] * clock.window;
      motion.position.push_back(motion_of(k, i));
      motion.velocity.push_back(-motion_of(k, i));
    }
    link.advance(motion, totals);
  }
  require(expected == windows + (clock.parallel ? 1 : 0), "windows are missing");
  link.finish(R"({"relaxation": {"at_rest": true}})");
}

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
  EXPECT_EQ(run.events("clock").at(0)["windows"], windows);
  EXPECT_EQ(run.events("sample").at(0)["values"]["centre_deflection_m"], 0.0);
  EXPECT_EQ(run.events("report").size(), 2u);
  const auto progress = run.events("progress");
  ASSERT_FALSE(progress.empty());  // at most ten a second, the last is never lost
  EXPECT_EQ(progress.back()["values"]["kinetic_J"], windows - 1);
  EXPECT_EQ(progress.back()["values"]["windows"], windows);
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
