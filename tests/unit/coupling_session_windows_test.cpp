// Law: the window clock. H from the rule, windows = ceil(until / H), window = until / windows; parallel grants window
// k + 1 to both when both have handed in k and drains the structure once; serial lets the load side go first. The only
// tolerance is 1e-12 relative in the ceiling: until / H of exact divisors carries two roundings of 1.1e-16.
#include <gtest/gtest.h>

#include "tests/unit/coupling_virtual_session.hpp"

namespace standoff::test {
namespace {

using Kind = WindowRule::Kind;

TEST(WindowClock, EachRule_GivesTheLengthItPromises) {
  const WindowNeeds load{1e-8, 4e-7}, structure{1e-7, 3e-7}, silent{1e-7, 0.0}, hasty{1e-7, 2e-8};
  EXPECT_EQ(decide_clock(1e-3, true, {Kind::structure_step, 0.0}, load, structure).windows, 10000);
  EXPECT_EQ(decide_clock(1e-3, true, {Kind::fixed, 1e-6}, load, structure).windows, 1000);
  EXPECT_EQ(decide_clock(1e-3, true, {Kind::automatic, 0.0}, load, structure).windows, 3334);  // 3e-7
  EXPECT_EQ(decide_clock(1e-3, true, {Kind::automatic, 0.0}, load, silent).windows, 2500);     // 4e-7
  EXPECT_EQ(decide_clock(1e-3, true, {Kind::automatic, 0.0}, load, hasty).windows, 10000);     // not below one step
  EXPECT_EQ(decide_clock(1e-3, true, {Kind::fixed, 1.0}, load, structure).windows, 1);
  EXPECT_EQ(decide_clock(1e-3, true, {Kind::fixed, 1e-3 / 3.0}, load, structure).window, 1e-3 / 3.0);
  EXPECT_THROW(decide_clock(1e-3, true, {Kind::structure_step, 0.0}, load, {0.0, 0.0}), Stop);
  EXPECT_THROW(decide_clock(1e-3, true, {Kind::fixed, 1e-15}, load, structure), Stop);
}

TEST(Windows, Parallel_BothGoOnTogetherAndTheStructureDrains) {
  VirtualSession run;
  run.start();
  for (std::int64_t k = 0; k < 4; ++k) {
    ASSERT_EQ(run.sent<message::Grant>("particles").size(), static_cast<std::size_t>(k + 1));
    run.advance(k % 2 ? "particles" : "structure", k);  // whoever comes first
    ASSERT_EQ(run.sent<message::Grant>("particles").size(), static_cast<std::size_t>(k + 1)) << "granted too early";
    run.advance(k % 2 ? "structure" : "particles", k);
  }
  EXPECT_EQ(run.stage("particles"), Stage::finishing);
  const auto grants = run.sent<message::Grant>("structure");
  ASSERT_EQ(grants.size(), 5u);
  EXPECT_TRUE(grants[4].drain && !grants[3].drain);
  EXPECT_EQ(grants[4].begin, 1.0);
  run.advance("structure", 4);
  EXPECT_EQ(run.stage("structure"), Stage::finishing);
}

TEST(Windows, Serial_LoadSideFirstAndNoDrain) {
  SessionRules rules = VirtualSession::default_rules();
  rules.parallel = false;
  VirtualSession run(rules);
  run.start();
  for (std::int64_t k = 0; k < 4; ++k) {
    ASSERT_EQ(run.stage("particles"), Stage::computing);
    ASSERT_EQ(run.stage("structure"), Stage::waiting);
    run.advance("particles", k);
    ASSERT_EQ(run.stage("structure"), Stage::computing);
    run.advance("structure", k);
  }
  EXPECT_EQ(run.sent<message::Grant>("structure").size(), 4u);
  EXPECT_EQ(run.sent<message::StopWindows>("particles").size(), 1u);
  EXPECT_EQ(run.sent<message::StopWindows>("structure").size(), 1u);
}

TEST(Windows, StopAskedFor_EndsBothAfterWhatHasBegun) {
  for (const bool parallel : {true, false}) {
    SessionRules rules = VirtualSession::default_rules();
    rules.parallel = parallel;
    VirtualSession run(rules);
    run.start();
    run.advance("particles", 0), run.advance("structure", 0);
    run.say("particles", message::StopWindows{0, "nothing moves any more"});
    run.advance("particles", 1), run.advance("structure", 1);
    if (parallel) run.advance("structure", 2);  // drain
    EXPECT_EQ(run.stage("particles"), Stage::finishing);
    EXPECT_EQ(run.stage("structure"), Stage::finishing);
    ASSERT_EQ(run.announced<announce::Stopping>().size(), 1u);
    EXPECT_EQ(run.announced<announce::Stopping>()[0].windows, 2);
  }
}

TEST(Windows, AllDone_LedgerAndGoodbyeOnce) {
  SessionRules rules = VirtualSession::default_rules();
  rules.parallel = false;
  VirtualSession run(rules);
  run.start();
  for (std::int64_t k = 0; k < 4; ++k) run.advance("particles", k), run.advance("structure", k);
  run.say("particles", message::Bye{});
  run.happen(Disconnected{"particles"});  // after its goodbye: nothing wrong
  EXPECT_TRUE(run.finished().empty());
  run.say("structure", message::Bye{});
  EXPECT_EQ(run.finished(), std::vector<int>{0});
  ASSERT_EQ(run.announced<announce::Interface>().size(), 1u);
  EXPECT_EQ(run.announced<announce::Interface>()[0].given.impulse.z, 4.0);
  EXPECT_EQ(run.announced<announce::Interface>()[0].received.impulse.z, 4.0);
  EXPECT_EQ(run.announced<announce::Done>().size(), 1u);
}

}  // namespace
}  // namespace standoff::test
