// Law: the recorded exchange of a small case (tests/contract/tape) is a fixture for each solver alone. The plate under
// the recorded load is a smooth function of it: other compilers and libraries differ by roundings, which 40 windows of
// some ten steps let grow to far less than 1e-9 of the motion. Gas under the recorded motion is chaotic: after a few
// collisions a rounding is another sample of the same gas, so the impulse is held to four standard errors of the some
// 30 simulated hits it is the sum of (5.5 N s of particles that give 0.2 N s each): 4 / sqrt(30) = 70 %. On the machine
// and build that recorded it the bits are equal.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class TapedRun : public LauncherStage {
 protected:
  TapedRun() { real_programs_ = true; }
  const std::string fixture = STANDOFF_SOURCE_DIR "/tests/contract/tape";
  const std::string recorded = fixture + "/recorded.tape";

  void run_taped(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",          fixture,   "--out",        name, "--tape",
                                       name + ".tape", "--quiet", "--checkpoint", "off"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(run(arguments), 0) << errors();
  }
  nlohmann::json diff(const std::string& first, const std::string& second) {
    files::remove(root_ / "out.txt");
    run({"tape", "diff", first, second, "--json"});
    return nlohmann::json::parse(output(), nullptr, false);
  }
};

TEST_F(TapedRun, RecordedLoad_DrivesThePlateAlone) {
  ASSERT_NO_FATAL_FAILURE(run_taped("plate", {"--particles", "replay:" + recorded}));
  const auto j = diff(recorded, "plate.tape");
  EXPECT_EQ(j["force_relative"], 0.0) << j;
  EXPECT_LT(j["position_relative"].get<double>(), 1e-9) << j;
  EXPECT_LT(j["velocity_relative"].get<double>(), 1e-9) << j;
  EXPECT_GT(j["windows"].get<int>(), 39) << j;
}

TEST_F(TapedRun, RecordedMotion_DrivesTheParticlesAlone) {
  ASSERT_NO_FATAL_FAILURE(run_taped("gas", {"--structure", "replay:" + recorded}));
  const auto j = diff(recorded, "gas.tape");
  EXPECT_EQ(j["position_relative"], 0.0) << j;
  ASSERT_EQ(run({"tape", "export", recorded, "--out", "table"}), 0) << errors();
  std::istringstream rows(read_file(root_ / "table/tape.csv"));
  double impulse = 0.0;
  for (std::string row; std::getline(rows, row);)
    if (row.starts_with("load,")) {
      std::istringstream fields(row);
      std::string field;
      for (int i = 0; i < 6; ++i) std::getline(fields, field, ',');
      impulse = std::stod(field);
    }
  ASSERT_LT(impulse, 0.0) << "N s, simulated quarter, towards the plate";
  const auto record = nlohmann::json::parse(read_file(root_ / "gas/run.json"), nullptr, false);
  EXPECT_NEAR(record["results"]["impulse_Ns"].get<double>() / (-4.0 * impulse), 1.0, 0.7);
}

TEST_F(TapedRun, TapeIsCutOrSpoilt_VerifyAndRunSaySo) {
  EXPECT_EQ(run({"tape", "verify", recorded}), 0) << output();
  const std::string whole = read_file(recorded);
  std::ofstream(root_ / "cut.tape") << whole.substr(0, whole.size() / 2);
  EXPECT_EQ(run({"tape", "verify", "cut.tape"}), 1);
  EXPECT_EQ(run({"run", fixture, "--particles", "replay:cut.tape", "--out", "short", "--quiet"}), 2);
  EXPECT_NE(errors().find("is asked for: let the run end earlier"), std::string::npos) << errors();
  std::ofstream(root_ / "other.tape") << "something else";
  EXPECT_EQ(run({"run", fixture, "--particles", "replay:other.tape", "--out", "none", "--quiet"}), 2);
  EXPECT_FALSE(files::exists(root_ / "none"));
}

}  // namespace
}  // namespace standoff::launch
