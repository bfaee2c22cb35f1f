// Law: death, silence and standstill are three failures with three detectors, the first failure wins, and time in which
// the broker itself did not run is nobody's fault. Virtual time in ticks of 0.5 s, so a deadline of D seconds is found
// at the first tick after D. No other tolerance.
#include <gtest/gtest.h>

#include "tests/unit/coupling_virtual_session.hpp"

namespace standoff::test {
namespace {

TEST(Deadlines, SomeoneDoesNotJoin_EndsAfterTheJoinDeadlineAndNamesHim) {
  VirtualSession run;
  run.join("particles", Role::load);
  run.pass_to(60.0);
  EXPECT_FALSE(run.state.over);
  run.pass_to(60.5);
  EXPECT_EQ(run.finished(), std::vector<int>{4});
  EXPECT_NE(run.cause().find("\"structure\" did not join within 60 s"), std::string::npos) << run.cause();
  EXPECT_EQ(run.sent<message::Abort>("particles").size(), 1u);
}

TEST(Deadlines, TheMissingOneWasTurnedAway_TheReasonIsGiven) {
  VirtualSession run;
  run.say("stranger", message::Hello{"sand", Role::load, "v", "case", 1, "host"});
  run.pass_to(60.5);
  EXPECT_NE(run.cause().find("within 60 s: \"sand\" was turned away, no participant named"), std::string::npos)
      << run.cause();
}

TEST(Deadlines, Silence_IsALostParticipant) {
  VirtualSession run;
  run.start();
  run.pass_to(5.0, false);
  EXPECT_FALSE(run.state.over);
  run.pass_to(5.5, false);
  EXPECT_NE(run.cause().find("particles, window 0: no sign of life for 5 s"), std::string::npos) << run.cause();
}

TEST(Deadlines, BeatsWithoutProgress_IsAStuckSolver) {
  VirtualSession run;
  run.start();
  run.advance("particles", 0);  // waits for the structure: not stuck
  run.pass_to(300.5);
  EXPECT_NE(run.cause().find("structure, window 0: no progress for 300 s"), std::string::npos) << run.cause();
}

TEST(Deadlines, BeatsWithProgress_MayTakeForEver) {
  VirtualSession run;
  run.start();
  for (int i = 1; i <= 100; ++i) {
    run.pass_to(20.0 * i);
    for (const char* name : {"particles", "structure"}) run.say(name, message::Beat{static_cast<std::uint64_t>(i)});
  }
  EXPECT_EQ(run.cause(), "none");
}

TEST(Deadlines, BrokerItselfAsleep_BlamesNobody) {
  VirtualSession run;
  run.start();
  run.pass_to(2.0);
  run.now += 1000.0;  // stopped and continued: the beats of that time are still unread
  run.happen(Tick{});
  EXPECT_EQ(run.cause(), "none");
  run.pass_to(run.now + 5.5, false);
  EXPECT_NE(run.cause(), "none") << "but from then on the deadline holds";
}

TEST(Deadlines, SomeoneWaits_IsReportedEveryFiveSecondsWithWhoAndWhere) {
  VirtualSession run;
  run.join("particles", Role::load);
  run.pass_to(16.0);
  auto waiting = run.announced<announce::Waiting>();
  ASSERT_EQ(waiting.size(), 3u);
  EXPECT_EQ(waiting[0].names, std::vector<std::string>{"structure"});
  EXPECT_EQ(waiting[0].since, 5.0);
  EXPECT_EQ(waiting[0].stage, "structure: not here yet");

  VirtualSession windows;
  windows.start();
  windows.advance("particles", 0);
  windows.pass_to(6.0);
  waiting = windows.announced<announce::Waiting>();
  ASSERT_EQ(waiting.size(), 1u);
  EXPECT_EQ(waiting[0].names, std::vector<std::string>{"structure"});
  EXPECT_EQ(waiting[0].stage, "structure (pid 1 on host), computing window 0");
}

TEST(Deadlines, BothComputeForLong_NobodyIsReportedAsWaitedFor) {
  VirtualSession run;
  run.start();
  run.pass_to(60.0);
  EXPECT_TRUE(run.announced<announce::Waiting>().empty());
}

TEST(Failures, SecondFailure_IsAConsequenceAndIsDropped) {
  VirtualSession run;
  run.start();
  run.say("structure", message::Abort{"structure", ExitCode::guard, "the plate is unstable", 0});
  run.happen(Disconnected{"structure"});
  run.happen(Disconnected{"particles"});
  run.say("particles", message::Abort{"particles", ExitCode::interrupted, "interrupted", 0});
  EXPECT_EQ(run.finished(), std::vector<int>{3});
  EXPECT_EQ(run.cause(), "first cause: structure, window 0: the plate is unstable");
  ASSERT_EQ(run.sent<message::Abort>("particles").size(), 1u);
  EXPECT_EQ(run.sent<message::Abort>("structure").size(), 1u) << "its own, as the first";
}

TEST(Failures, LostRepeatedOrForeignMessage_BreaksTheProtocol) {
  const auto spoilt = [](const std::function<void(Envelope&)>& change) {
    VirtualSession run;
    run.start();
    Received received{
        "particles", {"t", 1, run.find("particles")->received + 1, "particles", 0}, message::Beat{}, {}, nullptr, 0};
    change(received.envelope);
    run.happen(received);
    return run.cause();
  };
  EXPECT_EQ(spoilt([](Envelope&) {}), "none");
  EXPECT_NE(spoilt([](Envelope& e) { ++e.sequence; }).find("a message was lost or repeated"), std::string::npos);
  EXPECT_NE(spoilt([](Envelope& e) { --e.sequence; }).find("a message was lost or repeated"), std::string::npos);
  EXPECT_NE(spoilt([](Envelope& e) { e.token = "x"; }).find("another run token"), std::string::npos);
  EXPECT_NE(spoilt([](Envelope& e) { e.epoch = 7; }).find("belongs to connection 7"), std::string::npos);
}

TEST(Failures, AnotherSurfaceThanOffered_BreaksTheProtocol) {
  VirtualSession run;
  run.join("particles", Role::load);
  run.join("structure", Role::structure);
  run.offer_surface();
  run.say("particles", message::Ready{{0.25, 0.0}, "other"});
  EXPECT_NE(run.cause().find("its surface has digest other, the structure offered digest"), std::string::npos);
}

}  // namespace
}  // namespace standoff::test
