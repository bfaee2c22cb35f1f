// Law: --trace writes valid JSON with one track per process; the slices of a track do not overlap except that stages
// lie inside their window, and there are as many windows as were computed while they fit.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class TracedRun : public LauncherStage {
 protected:
  TracedRun() { real_programs_ = true; }
};

TEST_F(TracedRun, SmallCase_HasOneTrackPerProcessWithStagesInWindows) {
  ASSERT_EQ(
      run({"run", STANDOFF_SOURCE_DIR "/tests/contract/tape", "--out", "run", "--quiet", "--trace", "trace.json"}), 0)
      << errors();
  const auto trace = nlohmann::json::parse(read_file(root_ / "trace.json"), nullptr, false);
  ASSERT_TRUE(trace.is_object() && trace["traceEvents"].is_array());
  std::map<std::string, long> pids;
  std::map<long, long> windows, stages;
  std::map<long, double> end_of_window, begin_of_window, last_end;
  for (const auto& event : trace["traceEvents"]) {
    const long pid = event["pid"];
    if (event["ph"] == "M") {
      pids[event["args"]["name"]] = pid;
      continue;
    }
    const double begin = event["ts"], end = begin + event["dur"].get<double>();
    constexpr double rounding = 0.01;  // us, times are written with three decimals
    if (event["cat"] == "stage") {
      ++stages[pid];
      EXPECT_GE(begin, begin_of_window[pid] - rounding) << event;
      EXPECT_LE(end, end_of_window[pid] + rounding) << event;
      continue;
    }
    EXPECT_GE(begin, last_end[pid] - rounding) << event;
    last_end[pid] = end;
    if (event["cat"] == "compute") ++windows[pid], begin_of_window[pid] = begin, end_of_window[pid] = end;
  }
  ASSERT_EQ(pids.size(), 2u);
  EXPECT_EQ(windows[pids["particles"]], 40);
  EXPECT_EQ(windows[pids["structure"]], 41) << "with the one that applies the last load";
  EXPECT_GT(stages[pids["particles"]], 40);
  EXPECT_GT(stages[pids["structure"]], 40);
  EXPECT_FALSE(files::exists(root_ / "run/trace.particles"));
}

}  // namespace
}  // namespace standoff::launch
