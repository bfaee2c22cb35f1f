// Law: a participant on another host is one like any other: with keys both sides know it comes in over an encrypted
// connection; without them, or with a key the broker does not know, it is told so and ends with 2. The other host is a
// network namespace, joined to this one by a pair of virtual interfaces; skipped where the system does not allow that.
#include <gtest/gtest.h>
#include <sched.h>

#include "tests/contract/coupling_counting.hpp"

namespace standoff::test {
namespace {

constexpr const char* here = "10.77.0.1";

bool shell(const std::string& command) {
  return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

class OtherHost : public testing::Test {
 protected:
  void SetUp() override {
    // Once for the process: this test and its children leave the network of the machine alone.
    static const bool apart = unshare(CLONE_NEWNET) == 0 && shell("ip link set lo up");
    if (!apart) GTEST_SKIP() << "no network namespace can be made here: root and iproute2 are needed";
    for (const char* side : {"broker", "us", "stranger"}) write_new_keys(run.folder + "/" + side);
    run.broker.listen = std::string("tcp://") + here + ":*";
    run.broker.rules.deadlines.join = 3.0;
  }
  /// The load side on a host of its own.
  Child start_over_there(const ParticipantOptions& given) {
    const std::string ready = run.folder + "/host", linked = run.folder + "/linked";
    Child child(run.error_file("particles"), [=] {
      if (unshare(CLONE_NEWNET) != 0) return 96;
      std::ofstream(ready + ".new") << "";
      std::filesystem::rename(ready + ".new", ready);
      if (!eventually(10.0, [&] { return std::filesystem::exists(linked); })) return 95;
      if (!shell("ip addr add 10.77.0.2/24 dev there && ip link set there up")) return 94;
      return participant_main("standoff-particles", [&] { with_link(given, count_load); });
    });
    eventually(10.0, [&] { return std::filesystem::exists(ready); });
    shell("ip link del here");  // of the test before; that host's end goes some time after its last process
    EXPECT_TRUE(shell("ip link add here type veth peer name there netns " + std::to_string(child.pid())));
    EXPECT_TRUE(shell(std::string("ip addr add ") + here + "/24 dev here && ip link set here up"));
    std::ofstream(linked) << "";
    return child;
  }
  void make_address() {  // before anybody is there
    shell("ip link add address type dummy");
    ASSERT_TRUE(shell(std::string("ip addr replace ") + here + "/32 dev lo"));
  }
  void use_keys() { run.broker.keys = read_broker_keys(run.folder + "/broker.secret", run.folder + "/us.public"); }
  ParticipantOptions with_keys(ParticipantOptions given, const std::string& pair) const {
    given.keys = read_participant_keys(run.folder + "/" + pair + ".secret", run.folder + "/broker.public");
    return given;
  }
  void expect_a_whole_run(const std::function<ParticipantOptions(ParticipantOptions)>& equip) {
    Child broker = run.start_broker();
    Child structure = run.start(equip(run.options(Role::structure)), count_structure);
    Child load = start_over_there(equip(run.options(Role::load)));
    EXPECT_EQ(load.wait(), 0) << run.errors("particles");
    EXPECT_EQ(structure.wait(), 0) << run.errors("structure");
    EXPECT_EQ(broker.wait(), 0) << run.errors("broker");
  }
  CoupledRun run;
};

TEST_F(OtherHost, BothSidesHaveKeys_EveryValueArrives) {
  make_address();
  use_keys();
  expect_a_whole_run([&](ParticipantOptions given) { return with_keys(std::move(given), "us"); });
}

TEST_F(OtherHost, BothSidesSayInsecure_EveryValueArrives) {
  make_address();
  run.broker.insecure = true;
  expect_a_whole_run([](ParticipantOptions given) {
    given.insecure = true;
    return given;
  });
}

TEST_F(OtherHost, KeyTheBrokerDoesNotKnow_EndsWithTwo) {
  make_address();
  use_keys();
  Child broker = run.start_broker();
  Child load = start_over_there(with_keys(run.options(Role::load), "stranger"));
  EXPECT_EQ(load.wait(), 2) << run.errors("particles");
  EXPECT_NE(run.errors("particles").find("does not accept our keys"), std::string::npos) << run.errors("particles");
  EXPECT_EQ(broker.wait(), 4);
}

TEST(Host, AddressOthersCanReach_WithoutKeysNothingIsStarted) {
  for (const char* address : {"tcp://10.77.0.1:5555", "tcp://*:5555"}) {
    CoupledRun run;
    run.broker.listen = address;
    Child broker(run.error_file("broker"),
                 [&] { return participant_main("standoff-broker", [&] { run_broker(run.broker); }); });
    EXPECT_EQ(broker.wait(), 2);
    EXPECT_NE(run.errors("broker").find("not encrypted"), std::string::npos) << run.errors("broker");
    ParticipantOptions options = run.options(Role::load);
    options.endpoint = address;
    Child load = run.start(options, [](Participant&) {});
    EXPECT_EQ(load.wait(), 2);
  }
}

TEST(Host, SecretOthersCanRead_IsRefused) {
  CoupledRun run;
  write_new_keys(run.folder + "/us");
  std::filesystem::permissions(run.folder + "/us.secret", std::filesystem::perms(0644));
  try {
    read_participant_keys(run.folder + "/us.secret", run.folder + "/us.public");
    FAIL();
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::bad_case);
    EXPECT_NE(std::string(stop.what()).find("others can read this secret"), std::string::npos);
  }
}

}  // namespace
}  // namespace standoff::test
