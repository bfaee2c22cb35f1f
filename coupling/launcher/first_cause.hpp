#pragma once
// A failing run sets off an avalanche: one process dies, the broker notices, the other gives up. This decides which of
// the messages is the cause. Pure, so that every order of events can be tested.
#include <optional>
#include <string>
#include <vector>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/broker_events.hpp"

namespace standoff::launch {

/// How a process ended, in the order in which the launcher saw it.
struct ProcessEnd {
  std::string name;
  bool by_signal = false;
  int number = 0;  // exit status or signal
};

struct Cause {
  ExitCode code = ExitCode::participant_lost;
  std::string who;   // process name, "" for the launcher itself
  std::string what;  // "was killed by signal 9 (SIGKILL)"
  long window = -1;  // window the broker was in, if it said so
};

/// In this order: a process that a signal ended (nothing else explains itself less); what the broker called the first
/// failure, with the exit status of the process it names where the broker saw only a lost connection; a process that
/// ended with a status other than 0. Nothing if all is well so far.
std::optional<Cause> first_cause(const std::vector<ProcessEnd>& ends, const std::optional<FailedEvent>& failed);

/// "signal 9 (SIGKILL)"
std::string signal_text(int number);

}  // namespace standoff::launch
