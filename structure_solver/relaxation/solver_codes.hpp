#pragma once
// Every return code of CVODE and KINSOL 6.4.1 by name, what it means and what the relaxation does about it.
#include <span>
#include <string>
#include <string_view>

namespace standoff::structure {

enum class SolverAction {
  proceed,       // the solver did what was asked
  judge,         // it ended early: keep the result only if the measured residual dropped
  raise_limits,  // allow more steps and go on
  loosen,        // ask for less accuracy, by the factor the solver names
  refactor,      // assemble and factor the stiffness again at the present state, restart from there
  shorten,       // restart from the last accepted state with a far smaller step
  fall_back,     // go on with the explicit damped leapfrog (CVODE), or with more damped motion (KINSOL)
  stop,          // a defect or an exhausted machine: end the program
};

struct SolverCode {
  int code;
  std::string_view name;
  std::string_view meaning;
  SolverAction action;
};

std::span<const SolverCode> cvode_codes();
std::span<const SolverCode> kinsol_codes();

/// The entry of `code`; a code this table does not know stops the program.
const SolverCode& cvode_code(int code);
const SolverCode& kinsol_code(int code);

/// "refactors", "falls back to the explicit leapfrog", ... for messages.
std::string_view words_for(SolverAction action);

}  // namespace standoff::structure
