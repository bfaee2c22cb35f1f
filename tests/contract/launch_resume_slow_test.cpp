// Law: a run that was stopped in whatever way and resumed ends like one that was never stopped: the same rows of
// histories.csv byte for byte, the same fingerprint of both final states, the same results, also with another number of
// threads. What was committed to disk is never lost. The real programs on a small charge in sand; no tolerance.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class ResumedRun : public LauncherStage {
 protected:
  ResumedRun() { real_programs_ = true; }

  std::vector<std::string> run_into(const std::string& folder, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"run",
                                       "case.toml",
                                       "--out",
                                       folder,
                                       "--quiet",
                                       "--set",
                                       "soil.kind=dry",
                                       "--set",
                                       "soil.inner_radius=30 mm",
                                       "--set",
                                       "soil.outer_radius=76.2 mm",
                                       "--set",
                                       "soil.particles=4000",
                                       "--set",
                                       "levels.coarse.charge=800",
                                       "--set",
                                       "run.until=0.4 ms",
                                       "--set",
                                       "run.stand_off=80 mm"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  void run_whole() {
    start(run_into("whole", {"--checkpoint", "off", "--threads", "1"}));
    ASSERT_EQ(finish(120.0), 0) << errors();
  }
  /// Runs until some rows are written, then `stop`s it.
  int break_off(const std::function<void()>& stop) {
    start(run_into("run", {"--checkpoint", "30 windows", "--threads", "1"}));
    EXPECT_TRUE(wait_until([&] { return rows() > 12; }, 60.0)) << errors();
    stop();
    return finish(20.0);
  }
  int resume(const std::vector<std::string>& more = {}, rlim_t file_limit = 0) {
    std::vector<std::string> arguments{"resume", "run", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    start(arguments, {}, file_limit);
    return finish(120.0);
  }
  long rows() const {
    const std::string text = read_file(root_ / "run/histories.csv");
    return std::count(text.begin(), text.end(), '\n');
  }
  nlohmann::json record_of(const std::string& folder) const {
    return nlohmann::json::parse(read_file(root_ / folder / "run.json"), nullptr, false);
  }
  std::vector<files::path> checkpoints() const {
    std::vector<files::path> found;
    for (const auto& entry : files::directory_iterator(root_ / "run/checkpoint")) found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }
  void expect_same_as_whole() const {
    const auto whole = record_of("whole"), resumed = record_of("run");
    EXPECT_EQ(read_file(root_ / "run/histories.csv"), read_file(root_ / "whole/histories.csv"));
    EXPECT_EQ(read_file(root_ / "run/profile.csv"), read_file(root_ / "whole/profile.csv"));
    EXPECT_EQ(read_file(root_ / "run/impulse_map.csv"), read_file(root_ / "whole/impulse_map.csv"));
    EXPECT_EQ(resumed["provenance"]["state_hash"], whole["provenance"]["state_hash"]);
    EXPECT_EQ(resumed["results"], whole["results"]);
    EXPECT_EQ(resumed["counts"], whole["counts"]);
    EXPECT_EQ(resumed["coupling"], whole["coupling"]);
    EXPECT_EQ(resumed["status"], "done");
    EXPECT_GT(whole["results"]["impulse_sand_Ns"].get<double>(), 0.0);
    const auto frames = [&](const char* folder) {
      return std::distance(files::directory_iterator(root_ / folder / "particles"), files::directory_iterator());
    };
    EXPECT_EQ(frames("run"), frames("whole"));
  }
};

TEST_F(ResumedRun, StoppedBySigterm_SavesEndsWith130AndGoesOnWithTheSameBits) {
  run_whole();
  EXPECT_EQ(break_off([&] { kill(launcher_, SIGTERM); }), 130) << errors();
  expect_clean();
  EXPECT_EQ(record_of("run")["status"], "interrupted");
  EXPECT_NE(errors().find("standoff resume run"), std::string::npos) << errors();
  EXPECT_EQ(resume({"--threads", "2"}), 0) << errors();
  expect_same_as_whole();
  EXPECT_EQ(checkpoints().size(), 2u) << "the last two are kept";
}

TEST_F(ResumedRun, ProcessKilledAndThenOutOfTime_GoesOnWithTheSameBits) {
  run_whole();
  EXPECT_EQ(break_off([&] {
              const std::string launcher = std::to_string(launcher_);
              std::istringstream list(read_file("/proc/" + launcher + "/task/" + launcher + "/children"));
              for (pid_t pid; list >> pid;)
                if (read_file("/proc/" + std::to_string(pid) + "/cmdline").find("particles") != std::string::npos)
                  kill(pid, SIGKILL);
            }),
            4);
  const int code = resume({"--max-time", "1"});
  EXPECT_TRUE(code == 5 || code == 0) << "a fast machine may be done in a second; " << errors();
  if (code == 5) {
    EXPECT_NE(record_of("run")["reason"].get<std::string>().find("--max-time"), std::string::npos);
    EXPECT_EQ(resume(), 0) << errors();
  }
  expect_same_as_whole();
}

TEST_F(ResumedRun, DiskFull_EndsWithFiveAndLosesNothingThatWasCommitted) {
  run_whole();
  EXPECT_EQ(break_off([&] { kill(launcher_, SIGINT); }), 130) << errors();
  const auto before = checkpoints();
  ASSERT_FALSE(before.empty());
  const std::string state = read_file(before.back() / "particles.state");
  EXPECT_EQ(resume({"--checkpoint", "3 windows"}, state.size() / 2), 5) << "a state does not fit; " << errors();
  for (const auto& checkpoint : before) EXPECT_TRUE(files::exists(checkpoint / "checkpoint.json")) << checkpoint;
  EXPECT_EQ(read_file(before.back() / "particles.state"), state);
  EXPECT_EQ(resume(), 0) << errors();
  expect_same_as_whole();
}

TEST_F(ResumedRun, CheckpointThatDoesNotFit_EndsWithSixAndSaysWhy) {
  EXPECT_EQ(break_off([&] { kill(launcher_, SIGTERM); }), 130) << errors();
  const auto newest = checkpoints().back();
  const auto expect_six = [&](const std::string& why) {
    files::remove(root_ / "err.txt");
    EXPECT_EQ(resume(), 6) << errors();
    EXPECT_NE(errors().find(why), std::string::npos) << errors();
    expect_clean();
  };
  const std::string manifest = read_file(newest / "checkpoint.json");
  std::string other = manifest;
  other.replace(other.find("\"build\": \""), 10, "\"build\": \"9");
  std::ofstream(newest / "checkpoint.json") << other;
  expect_six("another build");
  std::ofstream(newest / "checkpoint.json") << manifest;

  const std::string state = read_file(newest / "structure.state");
  std::string damaged = state;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  std::ofstream(newest / "structure.state") << damaged;
  expect_six("structure.state is damaged");
  std::ofstream(newest / "structure.state") << state;

  std::string text = read_file(root_ / "run/case.resolved.toml");
  text.replace(text.find("seed = 1"), 8, "seed = 2");
  std::ofstream(root_ / "run/case.resolved.toml") << text;
  expect_six("case hash");
}

TEST_F(ResumedRun, WithoutCheckpointOrAlreadyDone_IsRefused) {
  start(run_into("run", {"--checkpoint", "off", "--set", "run.until=20 us", "--set", "run.settle=false"}));
  ASSERT_EQ(finish(60.0), 0) << errors();
  EXPECT_EQ(resume(), 2);
  EXPECT_NE(errors().find("is done"), std::string::npos) << errors();
  auto record = record_of("run");
  record["status"] = "interrupted";
  std::ofstream(root_ / "run/run.json") << record;
  EXPECT_EQ(resume(), 6);
  EXPECT_NE(errors().find("has no checkpoint"), std::string::npos) << errors();
}

}  // namespace
}  // namespace standoff::launch
