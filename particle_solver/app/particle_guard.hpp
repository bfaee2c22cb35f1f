#pragma once
// Stops a run whose particles are no longer worth believing: their energy books are open, or they pass through the
// plate.
//
//   |balance|  >  5 % of (initial energy + inflow), or not a number
//   passed through the plate, or set back on it  >  1 in 1000 of the particles at the start
//
// A particle has passed through when it is found a radius below the lowest point of the plate, inside its outline
// (step/boundaries.hpp). Swept hits let none through; an exchange that moves the plate by more than a particle between
// two windows does, and no other book shows it; gas it would leave behind is set back (step/surface_carry.hpp). Sound
// runs: below 0.5 %, and none.
#include "coupling/case/case_spec.hpp"
#include "particle_solver/ledger/particle_ledger.hpp"
#include "particle_solver/step/boundaries.hpp"
#include "particle_solver/step/surface_carry.hpp"

namespace standoff::particles {

inline constexpr double largest_open_share = 0.05, largest_passed_share = 1e-3;

/// Throws Stop(guard) with cause, time and remedy if `open_share`, the balance over the scale above, is too large.
void guard_particle_energy(const CaseSpec& spec, const ParticleEnergy& now, double open_share, double time);

/// Throws Stop(guard) with cause, place, time and remedy; `particles` at the start, `window` in s.
void guard_surface(const BoundaryTotals& totals, const CarriedGas& carried, long particles, double window, double time);

}  // namespace standoff::particles
