#pragma once
// Reads the command line, calls the verb, turns what is thrown into a message and an exit code.
#include <string>

namespace standoff::launch {

int launch(int argc, char** argv);

/// Seconds of "90", "90 s", "15 min" or "2 h"; throws Stop(bad_case) for anything else.
double wall_seconds(const std::string& text);

}  // namespace standoff::launch
