// Law (contract, sec. 3): whatever happens to whom at whatever moment, everyone is gone within ten seconds, with the
// exit code of the first failure and the same first cause; nothing is left; and every checkpoint that counts can be
// read. The faults are the lines of faults.csv. The ten seconds are the contract's; deadlines of the session are
// shortened where a fault is only found by one. Nothing else is a tolerance.
#include <atomic>

#include <sys/syscall.h>

#include "tests/contract/coupling_fault_scene.hpp"

namespace standoff::test {
namespace {

std::atomic<double> stall = 0.0;  // s

}  // namespace

void stall_next_flush(double seconds) {
  stall = seconds;
}

/// In this program in place of the one of the system, which it calls.
extern "C" int fsync(int file) {
  std::this_thread::sleep_for(std::chrono::duration<double>(stall.exchange(0.0)));
  return static_cast<int>(syscall(SYS_fsync, file));
}

namespace {

class Fault : public testing::TestWithParam<test::Fault> {
 protected:
  /// Exit code and first cause of one process.
  void expect_end(FaultScene& scene, const std::string& name, const std::string& code, const std::string& cause) {
    Child& process = scene.process(name);
    if (code == "-") return;
    EXPECT_EQ(process.wait(10.0), std::stoi(code)) << name << ": " << scene.run().errors(name);
    if (cause == "-") return;
    EXPECT_TRUE(holds(scene.run().cause(name), cause))
        << name << ": " << scene.run().cause(name) << "\n  not " << cause;
  }
  /// The same words from everyone who is not `who`, and from `who` unless it has a text of its own.
  void expect_one_cause(FaultScene& scene, const std::vector<std::string>& names) {
    for (const std::string& name : names) EXPECT_EQ(scene.run().cause(name), scene.run().cause(names[0])) << name;
  }
};

/// A real small disk for the checkpoints, seen by this test and its children alone; false where that is not allowed.
bool mount_small_disk(const std::string& folder) {
  std::filesystem::create_directory(folder);
  return unshare(CLONE_NEWNS) == 0 && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         mount("none", folder.c_str(), "tmpfs", 0, "size=300k") == 0;
}

/// What a broker that was killed left behind, the next one at the same place takes over and removes.
void let_the_next_broker_clean(CoupledRun& run) {
  std::filesystem::remove(run.folder + "/events");
  run.broker.rules.deadlines.join = 0.1;
  Child next = run.start_broker();
  EXPECT_EQ(next.wait(10.0), 4);
}

TEST_P(Fault, EveryoneEnds_WithOneCauseAndNothingLeft) {
  const test::Fault& fault = GetParam();
  FaultScene scene(fault);
  CoupledRun& run = scene.run();
  const std::string disk = run.folder + "/checkpoint";
  const bool small_disk = fault.what == "small disk";
  if (small_disk && !mount_small_disk(disk)) GTEST_SKIP() << "no tmpfs can be mounted here: root is needed";
  scene.start();

  std::vector<std::string> alike;
  for (const std::string name : {"broker", "particles", "structure"}) {
    // At rest the load side has said goodbye already.
    const bool gone_before = fault.at_rest() && name == "particles";
    const bool own = name == fault.who;
    const std::string code = gone_before                    ? "0"
                             : own && fault.own_code != "=" ? fault.own_code
                                                            : std::to_string(fault.code);
    const std::string cause = gone_before ? "-" : own && fault.own_cause != "=" ? fault.own_cause : fault.cause;
    expect_end(scene, name, code, cause);
    if (!gone_before && fault.cause != "-" && (!own || fault.own_cause == "=")) alike.push_back(name);
  }
  expect_one_cause(scene, alike);

  const std::vector<std::string> saved = checkpoints_in(disk);
  EXPECT_LE(saved.size(), 2u);
  for (const std::string& checkpoint : saved) EXPECT_NO_THROW(read_checkpoint(checkpoint)) << checkpoint;
  const bool early = fault.when == "join" || fault.when == "surface" || fault.when.ends_with(" -1");
  EXPECT_EQ(saved.empty(), early) << "what was committed before the fault is there";
  if (fault.who == "broker" && fault.own_code != "=") {
    scene.process("broker").signal(SIGKILL), scene.process("broker").wait();
    let_the_next_broker_clean(run);
  }
  EXPECT_TRUE(scene.leftovers().empty()) << scene.leftovers()[0];
  if (small_disk) umount2(disk.c_str(), MNT_DETACH);
}

std::string test_name(const testing::TestParamInfo<test::Fault>& info) {
  std::string name = info.param.name;
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  return name;
}
INSTANTIATE_TEST_SUITE_P(Table, Fault, testing::ValuesIn(read_faults()), test_name);

}  // namespace
}  // namespace standoff::test
