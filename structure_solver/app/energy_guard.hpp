#pragma once
// Stops a run whose structure gains or loses energy from nowhere. Plastic flow hides an unstable step: the deflection
// stays plausible while every step makes energy. The books do not:
//
//   |external work - kinetic - elastic - plastic - damping|  <=  5 % of the larger of
//       the largest external work so far   and   1/2 E (1e-3)^2 V, the plate strained by 1e-3 everywhere
//
// The second keeps the first hits, whose work is next to nothing, from being judged by their rounding. Sound runs stay
// below 0.5 %, and below 2 % where every hit lasts one step (ledger/README.md).
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {

inline constexpr double largest_open_share = 0.05;

/// Throws Stop(guard) with cause, place, time and remedy when the books are open, or not a number.
void guard_energy(const CaseSpec& spec, const StructuralModel& model, const StructureLedger& books, double peak_work);

/// True if every node of the frame is at a finite place: it can be shown.
bool can_be_shown(const StructureFrame& frame);

}  // namespace standoff::structure
