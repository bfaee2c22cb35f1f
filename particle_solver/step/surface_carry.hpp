#pragma once
// Stage surface_carry: takes along gas and air that the plate left behind when a window began.
//
// Where the plate is at the start of a window is not where the sheet was thought to be at the end of the last: it
// jumps, by the answer of the elements that the sheet does not know. A particle on the sheet is then up to that jump
// behind it, and one whose centre is more than its radius behind counts as gone past (surface_sheet.hpp). Such a one is
// set back with its centre on the sheet, where its next hit is found at once. Nothing but its place changes: no
// momentum, no energy. A particle that was not past the sheet before the jump cannot be farther behind than radius +
// jump, so none is lost. Many of them mean a window that is too long (app/particle_guard.hpp).
// Grains press on the sheet with a spring or are met by impulses; they are not moved.
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

/// Since the start.
struct CarriedGas {
  long particles = 0;
  Vec3 last;  // m, where one of them was
};

void surface_carry(GasState& gas, const SurfaceSheet& sheet, int threads, CarriedGas& carried);

}  // namespace standoff::particles
