#pragma once
// A participant as a program: the command line that the launcher gives and a user may, the case, the link, the exit
// code.
//
//   int main(int argc, char** argv) {
//     return standoff::participant_program(argc, argv, {"standoff-particles", "particles", Role::load, "..."}, run);
//   }
#include <functional>
#include <string>

#include "coupling/case/case_spec.hpp"
#include "coupling/contract/participant.hpp"

namespace standoff {

struct ParticipantIdentity {
  std::string program;  // as typed
  std::string name;     // in the run
  Role role = Role::load;
  std::string does;   // one line of help
  bool keeps = true;  // takes part in checkpoints: calls Participant::keep
};

struct ParticipantCommand {
  std::string case_file;                   // --case: case.toml or case.resolved.toml
  std::string level;                       // --level: only needed for a case that is not resolved
  std::string endpoint;                    // --connect
  std::string token;                       // --token
  std::string out;                         // --out: run folder, empty writes nothing
  std::string trace;                       // --trace: empty writes none
  std::string curve_secret, curve_server;  // key files, for a broker on another host
  bool insecure = false;                   // --insecure: or unencrypted
  int threads = 1;                         // --threads
  bool only_help = false;                  // --help was asked for and printed
};

/// Reads the command line; throws Stop(bad_case) with usage if it is wrong.
ParticipantCommand participant_command(int argc, char** argv, const ParticipantIdentity& identity);

using ParticipantBody = std::function<void(const CaseSpec&, const ParticipantCommand&, Participant&)>;

/// Reads command line and case, joins the run, calls `body`; returns the exit code. An old processor gets a message:
/// this file and the mains are not compiled for AVX2, everything numerical is.
int participant_program(int argc, char** argv, const ParticipantIdentity& identity, const ParticipantBody& body);

}  // namespace standoff
