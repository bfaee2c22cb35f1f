#pragma once
// What happens in a run, as JSON lines on standard output: one object a line, read by the launcher and by people.
// The list of events is in README.md.
#include <string>

#include "coupling/session/session.hpp"

namespace standoff {

/// Without the end of line. Throws Stop(participant_lost) if a report is not a JSON object.
std::string event_line(const Announcement& what);
/// The first line: where the broker can be reached, with the port filled in.
std::string listening_line(const std::string& endpoint);

}  // namespace standoff
