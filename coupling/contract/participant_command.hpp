#pragma once
// The command line that every participant program understands; the launcher gives it, and a user may.
#include <string>

#include "coupling/contract/participant.hpp"

namespace standoff {

struct ParticipantCommand {
  std::string case_file;   // --case: case.toml or case.resolved.toml
  std::string level;       // --level: only needed for a case that is not resolved
  std::string endpoint;    // --connect
  std::string token;       // --token
  std::string out;         // --out: run folder, empty writes nothing
  int threads = 1;         // --threads
  bool only_help = false;  // --help was asked for and printed
};

/// Reads the command line; throws Stop(bad_case) with usage if it is wrong.
ParticipantCommand participant_command(int argc, char** argv, const std::string& program, const std::string& does);

}  // namespace standoff
