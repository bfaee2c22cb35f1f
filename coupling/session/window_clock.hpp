#pragma once
// How long a coupling window is. The integer window is the clock, so the length divides the run exactly.
#include "coupling/session/messages.hpp"

namespace standoff {

struct WindowRule {
  enum class Kind {
    structure_step,  // one step of the structure
    fixed,           // `length`
    automatic,       // the largest window that both sides find accurate, not below one step of the structure
  };
  Kind kind = Kind::automatic;
  double length = 0.0;  // s, with `fixed`
};

/// windows = ceil(until / H), window = until / windows; H from the rule, the structure's step and both sides' limits.
/// Throws Stop if a step is not positive or the count is beyond reason.
CouplingClock decide_clock(double until, bool parallel, const WindowRule& rule, const WindowNeeds& load,
                           const WindowNeeds& structure);

}  // namespace standoff
