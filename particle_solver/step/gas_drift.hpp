#pragma once
// Stage gas_drift: the end of a sub-step. gas_collide has left every body at a virtual starting point from which a
// straight path leads to where it ends (state/media.hpp); here x += v h for the gas and, if given, the grains and the
// sheet.
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

void gas_drift(GasState& gas, SandState* sand, SurfaceSheet* sheet, double h);

}  // namespace standoff::particles
