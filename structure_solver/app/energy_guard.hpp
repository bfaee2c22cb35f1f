#pragma once
// Stops a run whose structure gains or loses energy from nowhere. Plastic flow hides an unstable step: the deflection
// stays plausible while every step makes energy. The books do not:
//
//   kinetic + elastic + plastic + damping - external work  <=   5 %,   >=  -25 %   of the larger of
//       the largest external work so far   and   1/2 E (1e-3)^2 V, the plate strained by 1e-3 everywhere
//
// The second keeps the first hits, whose work is next to nothing, from being judged by their rounding. An instability
// makes energy. Energy is lost, without harm, where a load lasts one step: central differences answer a load near the
// stiffest mode with up to 15 % less than its work (windows of one step, the first hits above all). Sound runs stay
// below 0.5 %, and end below 2 % where every hit lasts one step (ledger/README.md).
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {

inline constexpr double largest_made_share = 0.05, largest_lost_share = 0.25;

/// Throws Stop(guard) with cause, place, time and remedy when the books are open, or not a number.
void guard_energy(const CaseSpec& spec, const StructuralModel& model, const StructureLedger& books, double peak_work);

/// True if every node of the frame is at a finite place: it can be shown.
bool can_be_shown(const StructureFrame& frame);

}  // namespace standoff::structure
