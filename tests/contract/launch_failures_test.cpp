// Every way a run can break off (contract, sec. 3): the right exit code, the first cause named, run.json true, and no
// process, socket or temporary folder left. `finish` allows the 10 s of the contract.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

using Plays = std::map<std::string, std::string>;
const Plays everybody_hangs{{"FAKE_BROKER", "hang"}, {"FAKE_PARTICLES", "hang"}, {"FAKE_STRUCTURE", "hang"}};
const Plays everybody_is_stubborn{
    {"FAKE_BROKER", "stubborn"}, {"FAKE_PARTICLES", "stubborn"}, {"FAKE_STRUCTURE", "stubborn"}};

class LauncherFailure : public LauncherStage {
 protected:
  void start_and_wait(const Plays& plays, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"run", "case.toml", "--out", "run"});
    start(more, plays);
    ASSERT_TRUE(wait_until([&] { return all_playing(); }, 10.0));
  }
  void expect_record(const char* status, int code) const {
    EXPECT_EQ(record()["status"], status);
    EXPECT_EQ(record()["exit_code"], code);
    EXPECT_NE(record()["reason"], "");
  }
};

class LauncherKill : public LauncherFailure, public ::testing::WithParamInterface<const char*> {};

TEST_P(LauncherKill, ProcessKilledInMidRun_IsNamedAndNobodyIsLeft) {
  start_and_wait(everybody_hangs);
  kill(stand_ins().at(GetParam()), SIGKILL);
  EXPECT_EQ(finish(), 4);
  EXPECT_NE(errors().find(std::string(GetParam()) + ": was killed by signal 9"), std::string::npos) << errors();
  expect_record("failed", 4);
  expect_clean();
}
INSTANTIATE_TEST_SUITE_P(EachOfThree, LauncherKill, ::testing::Values("broker", "particles", "structure"));

TEST_F(LauncherFailure, GuardOfAParticipant_PassesItsCodeAndItsLastWords) {
  Plays plays = everybody_hangs;
  plays["FAKE_STRUCTURE"] = "exit3";
  EXPECT_EQ(run({"run", "case.toml", "--out", "run"}, plays), 3);
  EXPECT_NE(errors().find("element 5 turned inside out"), std::string::npos) << errors();
  expect_record("failed", 3);
  expect_clean();
}

TEST_F(LauncherFailure, FailureTheBrokerReports_IsToldWithTimeAndWindow) {
  Plays plays = everybody_hangs;
  plays["FAKE_BROKER"] = "failed";
  EXPECT_EQ(run({"run", "case.toml", "--out", "run"}, plays), 3);
  EXPECT_NE(errors().find("structure: element 7 turned inside out"), std::string::npos) << errors();
  EXPECT_NE(errors().find("window 412 of 1,000"), std::string::npos) << errors();
  expect_record("failed", 3);
  expect_clean();
}

TEST_F(LauncherFailure, TimeLimit_StopsEvenProcessesThatDoNotListen) {
  EXPECT_EQ(run({"run", "case.toml", "--out", "run", "--max-time", "1"}, everybody_is_stubborn), 5);
  expect_record("failed", 5);
  expect_clean();
}

TEST_F(LauncherFailure, InterruptAndTermination_StopTheRun) {
  for (const int number : {SIGINT, SIGTERM}) {
    files::remove_all(root_ / "run");
    for (const auto& entry : stand_ins()) files::remove(root_ / "pids" / entry.first);
    start_and_wait(everybody_hangs);
    kill(launcher_, number);
    EXPECT_EQ(finish(), 130);
    expect_record("interrupted", 130);
    expect_clean();
  }
}

TEST_F(LauncherFailure, SecondInterrupt_DoesNotWaitForTheDeaf) {
  start_and_wait(everybody_is_stubborn);
  kill(launcher_, SIGINT);
  ASSERT_TRUE(wait_until([&] { return record().is_object(); }, 1.0));
  kill(launcher_, SIGINT);
  EXPECT_EQ(finish(), 130);
  expect_clean();
}

TEST_F(LauncherFailure, LauncherKilled_TakesEveryoneAndTheSocketsWithIt) {
  start_and_wait(everybody_hangs);
  EXPECT_TRUE(sockets_left());
  kill(launcher_, SIGKILL);
  finish();
  EXPECT_TRUE(wait_until([&] { return !sockets_left(); }, 10.0));
  for (const char* name : {"broker", "particles", "structure"})
    EXPECT_TRUE(wait_until([&] { return kill(stand_ins().at(name), 0) != 0; }, 10.0)) << name;
}

TEST_F(LauncherFailure, FullDisk_StopsTheRunWithItsOwnCode) {
  start({"run", "case.toml", "--out", "run"},
        {{"FAKE_BROKER", "flood"}, {"FAKE_PARTICLES", "hang"}, {"FAKE_STRUCTURE", "hang"}}, 1 << 16);
  EXPECT_EQ(finish(), 5);
  EXPECT_NE(errors().find("histories.csv"), std::string::npos) << errors();
  expect_record("failed", 5);
  expect_clean();
}

TEST_F(LauncherFailure, ProcessesThatEndWithoutAResult_AreNoSuccess) {
  std::ofstream(root_ / "events") << "";
  EXPECT_EQ(run({"run", "case.toml", "--out", "run"}), 4);
  expect_record("failed", 4);
}

TEST_F(LauncherFailure, MissingProgram_IsSaidBeforeAnythingIsCreated) {
  files::remove(root_ / "bin/standoff-structure");
  EXPECT_EQ(run({"run", "case.toml"}), 4);
  EXPECT_NE(errors().find("standoff-structure is missing"), std::string::npos);
  EXPECT_FALSE(files::exists(root_ / "runs"));
}

TEST_F(LauncherFailure, WrongCase_CreatesNothing) {
  std::ofstream(root_ / "case.toml") << "[plate]\nmateral = \"al6xn\"\nsize = \"3 kg\"\n";
  EXPECT_EQ(run({"run", "case.toml"}), 2);
  EXPECT_NE(errors().find("nothing was started"), std::string::npos) << errors();
  EXPECT_FALSE(files::exists(root_ / "runs"));
  EXPECT_TRUE(stand_ins().empty());
}

TEST_F(LauncherFailure, FolderThatHoldsARunOrCannotExist_IsAWrongCommandLine) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "run"}), 0);
  const std::string before = read_file(root_ / "run/run.json");
  EXPECT_EQ(run({"run", "case.toml", "--out", "run"}), 2);
  EXPECT_EQ(read_file(root_ / "run/run.json"), before);
  EXPECT_EQ(run({"run", "case.toml", "--out", "case.toml/run"}), 2);
  expect_clean();
}

TEST_F(LauncherFailure, MistypedWord_IsMetWithTheRightOne) {
  EXPECT_EQ(run({"rnu", "case.toml"}), 2);
  EXPECT_EQ(run({"run", "--levle", "coarse", "case.toml"}), 2);
  EXPECT_NE(errors().find("did you mean \"run\"?"), std::string::npos);
  EXPECT_NE(errors().find("did you mean \"--level\"?"), std::string::npos);
}

}  // namespace
}  // namespace standoff::launch
