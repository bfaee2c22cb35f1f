#include "coupling/launcher/first_cause.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <string.h>

namespace standoff::launch {
namespace {

/// Statuses of the contract pass through; anything else (127, an abort of a library) is a lost participant.
ExitCode code_of(int status) {
  switch (status) {
    case 2:
    case 3:
    case 5:
    case 6:
    case 130:
      return static_cast<ExitCode>(status);
    default:
      return ExitCode::participant_lost;
  }
}

Cause cause_of_status(const ProcessEnd& end, long window) {
  return {code_of(end.number), end.name, fmt::format("ended with exit status {}", end.number), window};
}

}  // namespace

std::string signal_text(int number) {
  const char* name = sigabbrev_np(number);
  return fmt::format("signal {} ({}{})", number, name != nullptr ? "SIG" : "unknown", name != nullptr ? name : "");
}

std::optional<Cause> first_cause(const std::vector<ProcessEnd>& ends, const std::optional<FailedEvent>& failed) {
  const long window = failed ? failed->window : -1;
  for (const ProcessEnd& end : ends)
    if (end.by_signal)
      return Cause{ExitCode::participant_lost, end.name, "was killed by " + signal_text(end.number), window};
  if (failed) {
    const auto origin =
        std::find_if(ends.begin(), ends.end(), [&](const ProcessEnd& e) { return e.name == failed->origin; });
    const bool only_lost = code_of(failed->code) == ExitCode::participant_lost;
    if (only_lost && origin != ends.end() && code_of(origin->number) != ExitCode::participant_lost)
      return cause_of_status(*origin, window);
    return Cause{code_of(failed->code), failed->origin, failed->reason, window};
  }
  for (const ProcessEnd& end : ends)
    if (end.number != 0) return cause_of_status(end, window);
  return std::nullopt;
}

}  // namespace standoff::launch
