// The verbs that read run folders (contract sec. 2): status, watch, compare, report, on runs played by stand-ins that
// finish, fail, hang or were killed. Numbers are those that the stand-ins send.
#include <gmock/gmock.h>

#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class LauncherFolders : public LauncherStage {
 protected:
  /// What `standoff ARGUMENTS` prints; its exit code goes to code_.
  std::string said(const std::vector<std::string>& arguments) {
    files::remove(root_ / "out.txt");
    code_ = run(arguments);
    return output();
  }
  nlohmann::json told(const std::vector<std::string>& arguments) {
    return nlohmann::json::parse(said(arguments), nullptr, false);
  }
  /// A folder as a launcher leaves it that was killed long ago: marked running, nobody there.
  void abandon(const std::string& name) {
    ASSERT_EQ(run({"run", "case.toml", "--out", name, "--quiet"}), 0) << errors();
    auto j = nlohmann::json::parse(read_file(root_ / name / "run.json"));
    j["status"] = "running";
    j.erase("exit_code");
    std::ofstream(root_ / name / "run.json") << j;
    std::ofstream(root_ / name / "log.jsonl") << R"({"event":"joined","name":"particles","pid":999999999})"
                                              << "\n";
    for (const char* file : {"run.json", "log.jsonl"})
      files::last_write_time(root_ / name / file, files::file_time_type::clock::now() - std::chrono::minutes(1));
  }
  int code_ = -1;
};

TEST_F(LauncherFolders, StatusOfAFinishedRun_TellsResultAndErrors) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "run", "--quiet"}), 0) << errors();
  const auto j = told({"status", "run", "--json"});
  EXPECT_EQ(code_, 0);
  EXPECT_EQ(j["status"], "done");
  EXPECT_EQ(j["results"]["impulse_Ns"], 130.0);
  EXPECT_EQ(j["progress"]["window"], 400) << "the last progress that was reported";
  const std::string text = said({"status", "run"});
  EXPECT_THAT(text, HasSubstr("run: done"));
  EXPECT_THAT(text, HasSubstr("130.0 N s"));
  EXPECT_THAT(text, HasSubstr("interface work error         1 %"));
}

TEST_F(LauncherFolders, StatusOfAFailedRun_TellsTheReason) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "run", "--quiet"}, {{"FAKE_BROKER", "failed"}}), 3) << errors();
  const auto j = told({"status", "run", "--json"});
  EXPECT_EQ(code_, 0);
  EXPECT_EQ(j["status"], "failed");
  EXPECT_EQ(j["exit_code"], 3);
  EXPECT_FALSE(j["reason"].get<std::string>().empty());
  said({"watch", "run"});
  EXPECT_EQ(code_, 3) << "the exit code of the run";
}

TEST_F(LauncherFolders, RunningRun_IsFollowedUntilItEnds) {
  start({"run", "case.toml", "--out", "run", "--quiet"},
        {{"FAKE_BROKER", "hang"}, {"FAKE_PARTICLES", "hang"}, {"FAKE_STRUCTURE", "hang"}});
  ASSERT_TRUE(
      wait_until([&] { return read_file(root_ / "run/log.jsonl").find("\"progress\"") != std::string::npos; }, 10.0));
  const pid_t runner = std::exchange(launcher_, -1);
  const auto j = told({"status", "run", "--json"});
  EXPECT_EQ(j["status"], "running");
  EXPECT_EQ(j["progress"]["window"], 400);
  files::remove(root_ / "out.txt");
  start({"watch", "run"});
  EXPECT_TRUE(wait_until([&] { return output().find("window 400/1,000") != std::string::npos; }, 10.0)) << output();
  kill(runner, SIGTERM);
  EXPECT_EQ(finish(), 130) << output();
  EXPECT_THAT(output(), HasSubstr("run: interrupted"));
  waitpid(runner, nullptr, 0);
  expect_clean();
}

TEST_F(LauncherFolders, RunWhoseLauncherWasKilled_IsAbandonedAndWatchEnds) {
  abandon("run");
  EXPECT_EQ(told({"status", "run", "--json"})["status"], "abandoned");
  said({"watch", "run"});
  EXPECT_EQ(code_, 4);
}

TEST_F(LauncherFolders, FolderWithoutARun_IsExitTwo) {
  const std::vector<std::vector<std::string>> calls{
      {"status", "nowhere"}, {"watch", "nowhere"}, {"compare", "nowhere", "nowhere"}, {"report", "nowhere"}};
  for (const auto& call : calls) {
    EXPECT_EQ(run(call), 2) << call.front();
    EXPECT_THAT(errors(), HasSubstr("nowhere is not a run folder"));
  }
}

TEST_F(LauncherFolders, Compare_TellsTheInputThatDiffers) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "a", "--quiet"}), 0) << errors();
  ASSERT_EQ(run({"run", "case.toml", "--out", "b", "--quiet", "--seed", "2"}), 0) << errors();
  const auto j = told({"compare", "a", "b", "--json"});
  EXPECT_EQ(code_, 0);
  ASSERT_EQ(j["inputs"].size(), 1u) << j["inputs"].dump();
  EXPECT_EQ(j["inputs"][0], (nlohmann::json{{"key", "run.seed"}, {"a", "1"}, {"b", "2"}}));
  EXPECT_EQ(j["same_bits"], true);
  EXPECT_THAT(said({"compare", "a", "b"}), HasSubstr("run.seed"));
}

TEST_F(LauncherFolders, Report_IsOnePageThatNeedsNothingElse) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "a", "--quiet"}), 0) << errors();
  ASSERT_EQ(run({"report", "a"}), 0) << errors() << output();
  const std::string page = read_file(root_ / "a/report.html");
  EXPECT_THAT(page, HasSubstr("130 N s"));
  EXPECT_THAT(page, HasSubstr("20 mm"));
  for (const char* outside : {"src=\"http", "href=\"http", "<link", "<script"})
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  EXPECT_THAT(page, HasSubstr("<svg"));
  ASSERT_EQ(run({"report", "a", "a", "--out", "both.html"}), 0) << errors();
  EXPECT_THAT(read_file(root_ / "both.html"), HasSubstr("Side by side"));
}

TEST_F(LauncherFolders, ReportWithoutMatplotlib_HasTablesAndSaysWhatIsMissing) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "a", "--quiet"}), 0) << errors();
  const std::string folder = (root_ / "a").string();
  // -S: Python without the folder in which Debian installs matplotlib.
  const std::string command = "/usr/bin/python3 -B -S " STANDOFF_SOURCE_DIR "/coupling/report/run_report.py --out " +
                              folder + "/r.html " + folder + " > " + folder + "/said";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(read_file(root_ / "a/said"), HasSubstr("matplotlib is missing; install it with: apt-get install"));
  EXPECT_THAT(read_file(root_ / "a/r.html"), HasSubstr("130 N s"));
}

}  // namespace
}  // namespace standoff::launch
