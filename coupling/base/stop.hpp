#pragma once
// Exit codes are part of the user interface (sweeps retry on them), and every way to stop early carries one.
#include <stdexcept>
#include <string>

namespace standoff {

enum class ExitCode : int {
  done = 0,
  check_failed = 1,      // done, but a comparison asked for failed
  bad_case = 2,          // the case or the command line is wrong; nothing was started
  guard = 3,             // stopped by a guard: unstable or non-physical
  participant_lost = 4,  // a process died, froze or broke the protocol
  out_of_resources = 5,  // time limit, memory or disk
  checkpoint_incompatible = 6,
  interrupted = 130,
};

/// Ends the program with `code`; the text says what, where, why and how to fix it.
class Stop : public std::runtime_error {
 public:
  Stop(ExitCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace standoff
