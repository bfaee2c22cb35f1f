// The lines of the broker (table in coupling/launcher/README.md): every kind is read, everything else is left to the
// log.
#include <cmath>

#include <gtest/gtest.h>

#include "coupling/launcher/broker_events.hpp"

namespace standoff::launch {
namespace {

template <class Event>
Event read(const std::string& line) {
  const auto event = parse_event(line);
  EXPECT_TRUE(event.has_value() && std::holds_alternative<Event>(*event)) << line;
  return event && std::holds_alternative<Event>(*event) ? std::get<Event>(*event) : Event{};
}

TEST(BrokerEvents, EveryKind_IsRead) {
  EXPECT_EQ(read<JoinedEvent>(R"({"event":"joined","name":"particles","role":"load","pid":12})").pid, 12);
  EXPECT_EQ(read<ClockEvent>(R"({"event":"clock","window_s":1e-6,"windows":2000,"scheme":"parallel"})").windows, 2000);
  EXPECT_EQ(read<ProgressEvent>(R"({"event":"progress","name":"particles","values":{"window":3}})").values.at("window"),
            3.0);
  EXPECT_EQ(read<SampleEvent>(R"({"event":"sample","name":"structure","time_s":5e-6,"values":{}})").time_s, 5e-6);
  EXPECT_EQ(read<FailedEvent>(R"({"event":"failed","origin":"structure","code":3,"reason":"x","window":9})").window, 9);
  EXPECT_EQ(read<InterfaceEvent>(R"({"event":"interface","bytes":8,"impulse_given_Ns":[0,0,-1],
      "impulse_received_Ns":[0,0,-2],"work_given_J":3,"work_received_J":4})")
                .impulse_received_Ns[2],
            -2.0);
  read<DoneEvent>(R"({"event":"done"})");
}

TEST(BrokerEvents, Waiting_NamesWhoAndWhatTheyWereDoing) {
  const auto event = read<WaitingEvent>(
      R"({"event":"waiting","for":["structure"],"since_s":5.0,"stage":{"structure":"internal_force"}})");
  EXPECT_EQ(event.names, std::vector<std::string>{"structure"});
  EXPECT_EQ(event.stage, "structure: internal_force");
}

TEST(BrokerEvents, Report_IsAnObjectOrItsText) {
  EXPECT_EQ(read<ReportEvent>(R"({"event":"report","name":"a","report":{"x":1}})").report["x"], 1);
  EXPECT_EQ(read<ReportEvent>(R"({"event":"report","name":"a","report":"{\"x\":1}"})").report["x"], 1);
}

TEST(BrokerEvents, NumberThatIsNoNumber_IsNaN) {
  EXPECT_TRUE(std::isnan(read<ProgressEvent>(R"({"event":"progress","name":"a","values":{"v":null}})").values.at("v")));
}

TEST(BrokerEvents, AnyOtherLine_IsNoEvent) {
  for (const char* line :
       {"", "hello", "{", "[1]", R"({"event":"new kind"})", R"({"event":7})", R"({"event":"sample"})",
        R"({"event":"report","name":"a","report":"{"})", R"({"text":"no event"})"})
    EXPECT_FALSE(parse_event(line).has_value()) << line;
}

}  // namespace
}  // namespace standoff::launch
