#pragma once
// Stage detonate: lets gas particles go when the detonation front has reached them, t >= L / D [Borvik 2011, sec. 3.2].
// An impulse that a particle cannot carry goes to its neighbours ahead of the front (kernels/gas_release.hpp).
// Once none waits, the arrays of waiting are freed and later sub-steps do not test for them.
#include "particle_solver/search/gas_cell_grid.hpp"
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

/// Releases what is due at `time` [s]; returns how many were released. `idle` is a grid that is not in use, for its
/// memory.
long detonate(GasState& gas, double time, GasCellGrid* idle = nullptr);

/// Momentum and energy of the gas; a particle that waits counts with m v0 + J and with all of its energy.
struct GasTotals {
  Vec3 momentum;          // kg m/s
  double kinetic = 0.0;   // J
  double internal = 0.0;  // J
  double waiting = 0.0;   // J, kinetic (of the velocity-to-be) and internal, of unreleased particles
  double energy() const { return kinetic + internal + waiting; }
};
GasTotals gas_totals(const GasState& gas);

}  // namespace standoff::particles
