#pragma once
// What every participant's main needs: exceptions become messages and exit codes, signals and a dead launcher end the
// process, and whatever goes wrong is told to the others before it is told to the user.
//
//   int main(int argc, char** argv) {
//     return standoff::participant_main("standoff-particles", [&] {
//       const CaseSpec spec = ...;                                          // throws Stop(bad_case)
//       standoff::with_link(options, [&](Participant& link) { run_particles(spec, run_options, link); });
//     });
//   }
#include <functional>
#include <string>

#include "coupling/contract/participant.hpp"

namespace standoff {

/// Runs `body` and returns the exit code: 0, that of a Stop, 5 without memory, 3 for any other exception. A failure is
/// printed as "PROGRAM: error: ...". SIGINT, SIGTERM and the death of the parent end the process with 130, at the
/// latest after a grace of some seconds.
int participant_main(const std::string& program, const std::function<void()>& body) noexcept;

/// Joins the run, calls `body`, and tells everyone if it throws.
void with_link(const ParticipantOptions& options, const std::function<void(Participant&)>& body);

}  // namespace standoff
