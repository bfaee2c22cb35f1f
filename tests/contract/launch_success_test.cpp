// A run that goes well, played by stand-ins: what the contract (sec. 1, 2, 5) promises to be in the run folder
// afterwards, and that nothing else is left. Numbers are those that the stand-ins send.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

using LauncherSuccess = LauncherStage;

TEST_F(LauncherSuccess, FinishedRun_LeavesACompleteFolderAndNothingElse) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "run"}), 0) << errors();
  expect_clean();
  const auto j = record();
  EXPECT_EQ(j["status"], "done");
  EXPECT_EQ(j["exit_code"], 0);
  EXPECT_EQ(j["case"], "stage");
  EXPECT_EQ(j["level"], "coarse");
  EXPECT_EQ(j["results"]["impulse_Ns"], 130.0);
  EXPECT_EQ(j["results"]["permanent_centre_deflection_m"], 0.02);
  EXPECT_EQ(j["relaxation"]["at_rest"], true);
  EXPECT_EQ(j["counts"]["windows"], 1000);
  EXPECT_DOUBLE_EQ(j["conservation"]["interface_work_error"].get<double>(), 0.01);  // 101 given, 100 received
  EXPECT_EQ(j["provenance"]["state_hash"].get<std::string>().size(), 16u);
  for (const char* file : {"case.resolved.toml", "log.txt", "log.jsonl"})
    EXPECT_FALSE(read_file(root_ / "run" / file).empty()) << file;
  EXPECT_EQ(read_file(root_ / "run/histories.csv"),
            "time_s,impulse_Ns,centre_deflection_m,external_work_J,interface_work_error_J,work_to_structure_J\n"
            "0,0,0,0,0,0\n5e-06,130,0.001,100,1,101\n");
  EXPECT_NE(output().find("20.00 mm"), std::string::npos) << output();
}

TEST_F(LauncherSuccess, WithoutOut_FoldersAreNumbered) {
  ASSERT_EQ(run({"run", "case.toml", "--quiet"}), 0) << errors();
  ASSERT_EQ(run({"run", "case.toml", "--quiet"}), 0) << errors();
  EXPECT_TRUE(files::exists(root_ / "runs/stage/coarse-1/run.json"));
  EXPECT_TRUE(files::exists(root_ / "runs/stage/coarse-2/run.json"));
  EXPECT_EQ(output(), "");
}

TEST_F(LauncherSuccess, ResolvedCase_RunsAgainWithTheSameFingerprint) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "run"}), 0) << errors();
  const auto first = record()["provenance"]["case_hash"];
  files::rename(root_ / "run", root_ / "before");
  ASSERT_EQ(run({"run", "before/case.resolved.toml", "--out", "run"}), 0) << errors();
  EXPECT_EQ(record()["provenance"]["case_hash"], first);
}

TEST_F(LauncherSuccess, Participants_GetThreadsThatDoNotSpin) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "run", "--particle-threads", "3", "--structure-threads", "2"}), 0)
      << errors();
  const std::string environment = read_file(root_ / "environment_particles");
  for (const char* line : {"OMP_WAIT_POLICY=passive\n", "OMP_NUM_THREADS=3\n", "OPENBLAS_NUM_THREADS=1\n"})
    EXPECT_NE(environment.find(line), std::string::npos) << line;
  EXPECT_NE(read_file(root_ / "arguments_particles").find("--threads\n3\n"), std::string::npos);
  EXPECT_NE(read_file(root_ / "arguments_structure").find("--threads\n2\n"), std::string::npos);
}

TEST_F(LauncherSuccess, ProgressAsJson_IsOneObjectALine) {
  ASSERT_EQ(run({"run", "case.toml", "--out", "run", "--progress", "json"}), 0) << errors();
  std::istringstream lines(output());
  std::string line, last;
  while (std::getline(lines, line)) {
    const auto j = nlohmann::json::parse(line, nullptr, false);
    ASSERT_TRUE(j.is_object() && j.contains("event")) << line;
    last = j["event"];
  }
  EXPECT_EQ(last, "result");
}

TEST_F(LauncherSuccess, Study_RunsLevelsAndSeedsAndReusesThem) {
  ASSERT_EQ(run({"cost", "case.toml", "--seeds", "2", "--out", "study"}), 0) << errors();
  const std::string table = read_file(root_ / "study/cost.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3) << table;
  EXPECT_TRUE(read_file(root_ / "study/stages.csv").starts_with("level,seed,process,stage,seconds\n"));
  const auto written = files::last_write_time(root_ / "study/coarse-seed-1-1/run.json");
  ASSERT_EQ(run({"cost", "case.toml", "--seeds", "3", "--out", "study"}), 0) << errors();
  EXPECT_EQ(files::last_write_time(root_ / "study/coarse-seed-1-1/run.json"), written);
  EXPECT_FALSE(files::exists(root_ / "study/coarse-seed-1-2"));
  EXPECT_TRUE(files::exists(root_ / "study/coarse-seed-3-1/run.json"));
  expect_clean();
}

}  // namespace
}  // namespace standoff::launch
