// Which of several messages is the cause: the rule of coupling/launcher/first_cause.hpp, for every order of events that
// a failing run can show.
#include <gtest/gtest.h>

#include "coupling/launcher/first_cause.hpp"

namespace standoff::launch {
namespace {

using Ends = std::vector<ProcessEnd>;

TEST(FirstCause, AllWell_IsNothing) {
  EXPECT_FALSE(first_cause({}, {}).has_value());
  EXPECT_FALSE(first_cause(Ends{{"particles", false, 0}, {"structure", false, 0}}, {}).has_value());
}

TEST(FirstCause, KilledProcess_BeatsItsConsequences) {
  const Ends ends{{"structure", false, 4}, {"particles", true, 9}};
  const auto cause = first_cause(ends, FailedEvent{"particles", 4, "connection lost", 17});
  ASSERT_TRUE(cause.has_value());
  EXPECT_EQ(cause->who, "particles");
  EXPECT_EQ(cause->what, "was killed by signal 9 (SIGKILL)");
  EXPECT_EQ(cause->code, ExitCode::participant_lost);
  EXPECT_EQ(cause->window, 17);
}

TEST(FirstCause, ReasonTheBrokerKnows_BeatsAStatus) {
  const auto cause = first_cause(Ends{{"structure", false, 3}}, FailedEvent{"structure", 3, "element 5 inverted", 2});
  EXPECT_EQ(cause->what, "element 5 inverted");
  EXPECT_EQ(cause->code, ExitCode::guard);
}

TEST(FirstCause, BrokerSawOnlyALostConnection_StatusOfThatProcessCounts) {
  const auto cause = first_cause(Ends{{"particles", false, 5}}, FailedEvent{"particles", 4, "connection lost", 2});
  EXPECT_EQ(cause->code, ExitCode::out_of_resources);
  EXPECT_EQ(cause->what, "ended with exit status 5");
}

TEST(FirstCause, SignalToOneProcess_IsAnInterruption) {
  const Ends ends{{"structure", false, 130}, {"particles", false, 130}};
  const auto cause = first_cause(ends, FailedEvent{"structure", 130, "interrupted by SIGTERM", 2});
  EXPECT_EQ(cause->who, "structure");
  EXPECT_EQ(cause->code, ExitCode::interrupted);
}

TEST(FirstCause, FrozenProcess_IsWhatTheBrokerSays) {
  const auto cause = first_cause({}, FailedEvent{"structure", 4, "no heartbeat for 5 s", 2});
  EXPECT_EQ(cause->who, "structure");
  EXPECT_EQ(cause->code, ExitCode::participant_lost);
}

TEST(FirstCause, SeveralBadStatuses_FirstCounts) {
  const auto cause = first_cause(Ends{{"broker", false, 0}, {"structure", false, 3}, {"particles", false, 4}}, {});
  EXPECT_EQ(cause->who, "structure");
  EXPECT_EQ(cause->code, ExitCode::guard);
}

TEST(FirstCause, StatusOutsideTheContract_IsALostParticipant) {
  for (const int status : {1, 4, 127, 134, 255})
    EXPECT_EQ(first_cause(Ends{{"structure", false, status}}, {})->code, ExitCode::participant_lost) << status;
}

}  // namespace
}  // namespace standoff::launch
