#pragma once
// What a case does not state: presets, defaults, and values that follow from others. Afterwards every key that the
// scene needs has a value in SI, or its absence was reported.
#include "coupling/case/case_spec.hpp"
#include "coupling/case/settings.hpp"

namespace standoff {

void complete(Settings& settings, Diagnostics& diagnostics);

/// The same for the unit cell of the case's soil; forgets what else the case states.
void complete_cell(Settings& settings, Diagnostics& diagnostics);

/// True for a case with [cell] and without [plate].
bool describes_a_cell(const Settings& settings);

/// The settings as the solvers see them. Keys that were wrong or missing stay zero.
CaseSpec build_spec(const Settings& settings);

}  // namespace standoff
