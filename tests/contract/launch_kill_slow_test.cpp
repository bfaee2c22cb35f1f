// The real programs on a small case: whichever of the three processes dies or freezes in mid-run, the launcher names
// it, ends with 4 and leaves nothing (contract, sec. 3). The limit for a death is the contract's 10 s; a frozen process
// is known to be one only after the broker's silence limit of 5 s, so that test allows 15 s.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class RealRun : public LauncherStage, public ::testing::WithParamInterface<const char*> {
 protected:
  /// A run of minutes: nothing reaches the plate before its end, which is so coarse that a hit would end the run.
  void start_and_wait_for_rows() {
    real_programs_ = true;
    start({"run", "case.toml", "--out", "run", "--set", "run.until=100 ms", "--set", "coupling.window=step", "--set",
           "levels.coarse.charge=2000", "--set", "run.stand_off=600 m"});
    ASSERT_TRUE(wait_until([&] { return rows() > 3; }, 60.0)) << errors();
  }
  long rows() const {
    const std::string text = read_file(root_ / "run/histories.csv");
    return std::count(text.begin(), text.end(), '\n');
  }
  /// Processes of the run by the name of their program.
  std::map<std::string, pid_t> processes() const {
    std::map<std::string, pid_t> found;
    const std::string launcher = std::to_string(launcher_);
    std::istringstream list(read_file("/proc/" + launcher + "/task/" + launcher + "/children"));
    for (pid_t pid; list >> pid;) {
      const std::string program =
          files::path(read_file("/proc/" + std::to_string(pid) + "/cmdline").c_str()).filename();
      if (program.starts_with("standoff-")) found[program.substr(9)] = pid;
    }
    return found;
  }
  void expect_all_gone(const std::map<std::string, pid_t>& before) const {
    for (const auto& [name, pid] : before) EXPECT_NE(kill(pid, 0), 0) << name << " outlived the launcher";
    EXPECT_FALSE(sockets_left());
    EXPECT_EQ(record()["status"], "failed");
    EXPECT_EQ(record()["exit_code"], 4);
  }
};

TEST_P(RealRun, ProcessKilledInMidRun_IsNamedAndNothingIsLeft) {
  start_and_wait_for_rows();
  const auto before = processes();
  ASSERT_EQ(before.size(), 3u);
  kill(before.at(GetParam()), SIGKILL);
  EXPECT_EQ(finish(), 4);
  EXPECT_NE(errors().find(std::string(GetParam()) + ": was killed by signal 9"), std::string::npos) << errors();
  expect_all_gone(before);
}

TEST_P(RealRun, ProcessFrozenInMidRun_EndsTheRun) {
  start_and_wait_for_rows();
  const auto before = processes();
  ASSERT_EQ(before.size(), 3u);
  kill(before.at(GetParam()), SIGSTOP);
  EXPECT_EQ(finish(15.0), 4);
  EXPECT_NE(errors().find(GetParam()), std::string::npos) << errors();
  expect_all_gone(before);
}

TEST_P(RealRun, ProcessTerminatedInMidRun_SavesFirstAndEndsWith130) {
  start_and_wait_for_rows();
  const auto before = processes();
  ASSERT_EQ(before.size(), 3u);
  kill(before.at(GetParam()), SIGTERM);
  EXPECT_EQ(finish(40.0), 130) << "a window and a checkpoint later; " << errors();
  EXPECT_NE(errors().find(std::string(GetParam()) + ": interrupted by SIGTERM; a checkpoint holds"), std::string::npos)
      << errors();
  EXPECT_EQ(record()["status"], "interrupted");
  for (const auto& [name, pid] : before) EXPECT_NE(kill(pid, 0), 0) << name << " outlived the launcher";
  EXPECT_FALSE(sockets_left());
}

INSTANTIATE_TEST_SUITE_P(EachOfThree, RealRun, ::testing::Values("broker", "particles", "structure"));

}  // namespace
}  // namespace standoff::launch
