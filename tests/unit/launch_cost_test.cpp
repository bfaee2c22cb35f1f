// Statistics of the accuracy-time study: means, spreads and errors by hand (definitions in cost_statistics.hpp).
// Tolerances are rounding of sums of a few numbers.
#include <cmath>

#include <gtest/gtest.h>

#include "coupling/launcher/cost_statistics.hpp"
#include "coupling/launcher/cost_study.hpp"
#include "coupling/launcher/stage_costs.hpp"

namespace standoff::launch {
namespace {

CostRun run(const std::string& level, double deflection, double seconds, int exit_code = 0) {
  CostRun r;
  r.level = level, r.permanent_m = deflection, r.peak_m = deflection, r.impulse_Ns = 100.0, r.seconds = seconds;
  r.exit_code = exit_code;
  return r;
}

TEST(CostStatistics, Spread_IsTheSampleDeviation) {
  const Spread s = spread_of({1.0, 2.0, 3.0, std::nan("")});
  EXPECT_EQ(s.count, 3);
  EXPECT_DOUBLE_EQ(s.mean, 2.0);
  EXPECT_DOUBLE_EQ(s.deviation, 1.0);
  EXPECT_DOUBLE_EQ(s.standard_error(), 1.0 / std::sqrt(3.0));
}

TEST(CostStatistics, OneRun_HasNoSpread) {
  EXPECT_TRUE(std::isnan(spread_of({1.0}).deviation));
}

TEST(CostStatistics, ErrorOfALevel_IsItsDistanceFromTheFinest) {
  const auto costs = level_costs(
      {run("coarse", 30.0, 1), run("coarse", 32.0, 1), run("fine", 29.0, 9), run("fine", 29.0, 9)}, {"coarse", "fine"});
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_DOUBLE_EQ(costs[0].permanent.difference, 2.0);
  EXPECT_DOUBLE_EQ(costs[0].permanent.standard_error, 1.0);  // sqrt(2)/sqrt(2) and 0
  EXPECT_DOUBLE_EQ(costs[1].permanent.difference, 0.0);
  EXPECT_DOUBLE_EQ(costs[1].permanent.standard_error, 0.0);
}

TEST(CostStatistics, FailedRun_IsCountedButNotAveraged) {
  const auto costs = level_costs({run("coarse", 30.0, 1), run("coarse", 99.0, 1, 3)}, {"coarse", "fine"});
  ASSERT_EQ(costs.size(), 1u);
  EXPECT_EQ(costs[0].runs, 1);
  EXPECT_EQ(costs[0].failed, 1);
  EXPECT_DOUBLE_EQ(costs[0].permanent.own.mean, 30.0);
}

TEST(CostStatistics, FinestLevelFailed_NextOneIsTheReference) {
  const auto costs = level_costs({run("coarse", 30.0, 1), run("medium", 28.0, 4), run("fine", 0.0, 9, 5)},
                                 {"coarse", "medium", "fine"});
  EXPECT_DOUBLE_EQ(costs[0].permanent.difference, 2.0);
}

TEST(CostStatistics, LevelToChoose_IsTheCheapestWithinTheErrorAndItsUncertainty) {
  // coarse is 10 % off, medium 2 % off with a standard error of 1 %: |2| + 2 x 1 = 4 %.
  std::vector<CostRun> runs{run("coarse", 110.0, 1), run("coarse", 110.0, 1), run("medium", 101.0, 4),
                            run("medium", 103.0, 4), run("fine", 100.0, 9),   run("fine", 100.0, 9)};
  const auto costs = level_costs(runs, {"coarse", "medium", "fine"});
  EXPECT_EQ(level_for_error(costs, 0.11), "coarse");
  EXPECT_EQ(level_for_error(costs, 0.05), "medium");
  EXPECT_EQ(level_for_error(costs, 0.035), "fine");
}

TEST(CostStatistics, OnlyOneLevel_ShowsNothing) {
  EXPECT_EQ(level_for_error(level_costs({run("coarse", 1.0, 1), run("coarse", 1.0, 1)}, {"coarse"}), 0.5), "");
}

TEST(CostStatistics, OneSeedOfACoarserLevel_ProvesNothing) {
  EXPECT_EQ(level_for_error(level_costs({run("coarse", 1.0, 1), run("fine", 1.0, 9)}, {"coarse", "fine"}), 0.5),
            "fine");
}

TEST(CostStudy, Budget_TakesLevelsInOrderAndAlwaysTheFirst) {
  EXPECT_EQ(levels_within({10.0, 20.0, 30.0}, 30.0), 2u);
  EXPECT_EQ(levels_within({10.0, 20.0, 30.0}, 1000.0), 3u);
  EXPECT_EQ(levels_within({10.0, 20.0}, 1.0), 1u);
}

TEST(CostStatistics, Csv_LeavesUnknownValuesEmpty) {
  const std::string text = cost_csv({run("coarse", 0.5, 2.0)});
  EXPECT_NE(text.find("coarse,0,0,0,0,0,0.5,,0.5,100,2,,,\n"), std::string::npos) << text;
}

CostRun timed(const std::string& level, double pairs, double wait, int exit_code = 0) {
  CostRun r = run(level, 1.0, 1.0, exit_code);
  r.stages = {{"particle", "sand_pairs", pairs}, {"particle", "wait", wait}, {"structure", "relax", 2.0}};
  return r;
}

TEST(StageCosts, TableOfTwoRuns_HasMeansAndSharesOfTheirProcess) {
  const std::string text =
      stage_table({timed("coarse", 2.0, 1.0), timed("coarse", 4.0, 1.0), timed("coarse", 90.0, 0.0, 3)}, {"coarse"});
  EXPECT_NE(text.find("sand_pairs   3.0 s 75.0 %"), std::string::npos) << text;
  EXPECT_NE(text.find("1.0 s 25.0 %"), std::string::npos) << text;
  EXPECT_NE(text.find("2.0 s 100.0 %"), std::string::npos) << text;
}

TEST(StageCosts, Csv_LeavesFailedRunsOut) {
  EXPECT_EQ(stage_csv({timed("coarse", 2.0, 1.0), timed("coarse", 90.0, 0.0, 3)}),
            "level,seed,process,stage,seconds\ncoarse,0,particle,sand_pairs,2\ncoarse,0,particle,wait,1\n"
            "coarse,0,structure,relax,2\n");
}

TEST(StageCosts, RecordOfARun_GivesStagesExchangeAndWait) {
  const auto times = stage_times_of(
      OrderedJson::parse(R"({"timing": {"particle": {"exchange_s": 0.5, "stages": {"hard_core": 2}, "wait_s": 1}}})"));
  ASSERT_EQ(times.size(), 3u);
  EXPECT_EQ(times[0].stage, "hard_core");
  EXPECT_DOUBLE_EQ(times[0].seconds + times[1].seconds + times[2].seconds, 3.5);
}

}  // namespace
}  // namespace standoff::launch
