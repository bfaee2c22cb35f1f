#pragma once
// What the broker tells the launcher, one JSON object a line on its standard output; README.md lists the members.
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace standoff::launch {

using Values = std::map<std::string, double>;

struct JoinedEvent {
  std::string name, role;
  long pid = 0;
};
struct ClockEvent {
  double window_s = 0.0;
  long windows = 0;
  std::string scheme;
};
struct WaitingEvent {
  std::vector<std::string> names;
  double since_s = 0.0;
  std::string stage;  // what each was last doing, in words
};
struct ProgressEvent {
  std::string name;
  Values values;
};
struct SampleEvent {
  std::string name;
  double time_s = 0.0;
  Values values;
};
struct ReportEvent {
  std::string name;
  nlohmann::json report;
};
/// Ledger of the interface, as simulated (a quarter model counts once).
struct InterfaceEvent {
  double bytes = 0.0;
  std::array<double, 3> impulse_given_Ns{}, impulse_received_Ns{};
  double work_given_J = 0.0, work_received_J = 0.0;
};
struct FailedEvent {
  std::string origin;
  int code = 4;
  std::string reason;
  long window = -1;
};
/// An interrupted run goes on until it has saved.
struct SavingEvent {
  std::string reason;
};
struct CheckpointEvent {
  long windows = 0;  // done
  double time_s = 0.0, bytes = 0.0;
};
struct DoneEvent {};

using BrokerEvent = std::variant<JoinedEvent, ClockEvent, WaitingEvent, ProgressEvent, SampleEvent, ReportEvent,
                                 InterfaceEvent, SavingEvent, CheckpointEvent, FailedEvent, DoneEvent>;

/// Nothing for a line that is not one of the events above: such lines go to the log as they are.
std::optional<BrokerEvent> parse_event(const std::string& line);

}  // namespace standoff::launch
