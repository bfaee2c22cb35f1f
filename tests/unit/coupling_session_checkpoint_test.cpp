// Law: a checkpoint is made at the end of a window, while both sides wait; it counts once both have saved and the
// broker's half is on disk; a run that is taken up again gets the grants that the first would have got. Virtual time,
// exact.
#include <gtest/gtest.h>

#include "tests/unit/coupling_virtual_session.hpp"

namespace standoff::test {
namespace {

SessionRules saving_rules(bool parallel, double every, std::int64_t every_windows) {
  SessionRules rules = VirtualSession::default_rules();
  rules.parallel = parallel;
  rules.checkpoint = {"/run/checkpoint", every, every_windows};
  return rules;
}

void both_advance(VirtualSession& run, std::int64_t window) {
  run.advance("particles", window);
  run.advance("structure", window);
}
void both_save(VirtualSession& run, std::int64_t windows) {
  run.saved("particles", windows);
  run.saved("structure", windows);
}

class Checkpoints : public testing::TestWithParam<bool> {};

TEST_P(Checkpoints, EverySecondWindow_AreMadeThereAndBeforeTheEnd) {
  VirtualSession run(saving_rules(GetParam(), 0.0, 2));
  run.start();
  both_advance(run, 0), both_advance(run, 1);
  ASSERT_EQ(run.stage("particles"), Stage::saving);
  ASSERT_EQ(run.stage("structure"), Stage::saving);
  EXPECT_EQ(run.sent<message::Checkpoint>("structure").at(0).windows, 2);
  EXPECT_EQ(run.sent<message::Checkpoint>("structure").at(0).folder, "/run/checkpoint/window-000000002.part");
  run.saved("structure", 2);
  EXPECT_TRUE(run.commits().empty()) << "only one side has saved";
  run.saved("particles", 2);
  ASSERT_EQ(run.commits().size(), 1u);
  EXPECT_EQ(run.commits()[0].clock.first, 2);
  EXPECT_EQ(run.commits()[0].given.impulse.z, 2.0) << "the ledger after window 1";
  EXPECT_EQ(run.sent<message::Grant>("particles").size(), 2u) << "nobody goes on before all is on disk";
  run.happen(Committed{});
  EXPECT_EQ(run.announced<announce::Checkpoint>().at(0).windows, 2);
  EXPECT_EQ(run.sent<message::Grant>("particles").at(2).window, 2);
  both_advance(run, 2), both_advance(run, 3);
  EXPECT_EQ(run.stage("structure"), Stage::saving) << "before the last load is applied and the plate comes to rest";
  both_save(run, 4), run.happen(Committed{});
  EXPECT_EQ(run.stage("particles"), Stage::finishing);
  EXPECT_EQ(run.stage("structure"), GetParam() ? Stage::computing : Stage::finishing);
}

TEST_P(Checkpoints, ByTime_AreMadeWhenSoManySecondsHavePassed) {
  VirtualSession run(saving_rules(GetParam(), 10.0, 0));
  run.start();
  both_advance(run, 0);
  EXPECT_EQ(run.stage("particles"), Stage::computing);
  run.pass_to(10.0);
  both_advance(run, 1);
  EXPECT_EQ(run.stage("particles"), Stage::saving);
  both_save(run, 2), run.happen(Committed{});
  both_advance(run, 2);
  EXPECT_NE(run.stage("particles"), Stage::saving) << "the ten seconds begin anew";
}

TEST_P(Checkpoints, TakenUpAgain_TheGrantsGoOnWhereTheyStopped) {
  VirtualSession first(saving_rules(GetParam(), 0.0, 3));
  first.start();
  for (std::int64_t k = 0; k < 3; ++k) both_advance(first, k);
  both_save(first, 3);
  SessionRules rules = saving_rules(GetParam(), 0.0, 3);
  rules.resume = ResumePoint{first.commits().at(0), "/run/checkpoint/window-000000003"};
  VirtualSession second(rules);
  second.start();
  const auto start = second.sent<message::Start>("structure").at(0);
  EXPECT_EQ(start.clock.first, 3);
  EXPECT_EQ(start.folder, "/run/checkpoint/window-000000003");
  EXPECT_EQ(start.checksum, 7u);
  EXPECT_EQ(second.sent<message::Grant>("particles").at(0).window, 3);
  both_advance(second, 3);
  both_save(second, 4), second.happen(Committed{});
  if (GetParam()) second.advance("structure", 4);
  second.say("particles", message::Bye{}), second.say("structure", message::Bye{});
  EXPECT_EQ(second.finished(), std::vector<int>{0}) << second.cause();
}

TEST_P(Checkpoints, Interrupted_TheRunSavesAtTheEndOfTheWindowAndStops) {
  VirtualSession run(saving_rules(GetParam(), 0.0, 0));
  run.start();
  run.happen(Interrupted{"interrupted by SIGTERM"});
  EXPECT_EQ(run.announced<announce::Saving>().size(), 1u);
  run.pass_to(5.0);
  both_advance(run, 0);
  both_save(run, 1);
  EXPECT_TRUE(run.finished().empty());
  run.happen(Committed{});
  EXPECT_EQ(run.finished(), std::vector<int>{130});
  EXPECT_NE(run.cause().find("interrupted by SIGTERM; a checkpoint holds 1 windows"), std::string::npos) << run.cause();
}

INSTANTIATE_TEST_SUITE_P(Coupling, Checkpoints, testing::Bool(),
                         [](const auto& given) { return given.param ? "parallel" : "serial"; });

TEST(Checkpoint, OneSideInterrupted_TheRunSavesAndNamesIt) {
  VirtualSession run(saving_rules(true, 0.0, 0));
  run.start();
  run.say("structure", message::StopWindows{0, "interrupted by SIGTERM", true});
  EXPECT_EQ(run.announced<announce::Saving>().size(), 1u);
  both_advance(run, 0);
  both_save(run, 1), run.happen(Committed{});
  EXPECT_EQ(run.finished(), std::vector<int>{130});
  EXPECT_EQ(run.cause(), "first cause: structure, window 0: interrupted by SIGTERM; a checkpoint holds 1 windows");
}

TEST(Checkpoint, InterruptedButAWindowTakesTooLong_TheRunStopsWithoutIt) {
  VirtualSession run(saving_rules(true, 0.0, 0));
  run.start();
  run.happen(Interrupted{"interrupted by SIGINT"});
  run.pass_to(run.state.rules.deadlines.save + 1.0);
  EXPECT_EQ(run.finished(), std::vector<int>{130});
}

TEST(Checkpoint, DiskFull_EndsTheRunWithFive) {
  VirtualSession run(saving_rules(true, 0.0, 1));
  run.start();
  both_advance(run, 0);
  both_save(run, 1);
  run.happen(DiskFailed{"cannot write interface.state: No space left on device"});
  EXPECT_EQ(run.finished(), std::vector<int>{5});
  EXPECT_TRUE(run.announced<announce::Checkpoint>().empty());
}

TEST(Checkpoint, OneSideCannotSave_NoneIsMadeAndASignalEndsTheRunAtOnce) {
  VirtualSession run(saving_rules(true, 0.0, 1));
  run.keeps = false;
  run.start();
  both_advance(run, 0);
  EXPECT_EQ(run.stage("particles"), Stage::computing);
  run.happen(Interrupted{"interrupted by SIGINT"});
  EXPECT_EQ(run.finished(), std::vector<int>{130});
}

TEST(Checkpoint, OfAnotherCase_IsRefusedWithSix) {
  VirtualSession first(saving_rules(true, 0.0, 1));
  first.start();
  both_advance(first, 0), both_save(first, 1);
  SessionRules rules = saving_rules(true, 0.0, 1);
  rules.resume = ResumePoint{first.commits().at(0), "/f"};
  rules.resume->state.case_hash = "another";
  VirtualSession second(rules);
  second.start();
  EXPECT_EQ(second.finished(), std::vector<int>{6});
  EXPECT_NE(second.cause().find("case hash another"), std::string::npos) << second.cause();
}

}  // namespace
}  // namespace standoff::test
