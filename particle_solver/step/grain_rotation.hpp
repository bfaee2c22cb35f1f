#pragma once
// Stage grain_rotation: the kicks of velocity Verlet for the spins of grains, beside those of sand_integrate.
//   w += (dt/2) T/I,  I = 2/5 m r^2
// The torques T are set by SandPairs::forces, and the spins slide the surfaces there; law: kernels/grain_rotation.hpp.
// A sphere looks the same whichever way round it is, so nobody keeps an orientation. On the plate, surface_contact
// turns grains where the plate has friction. Gas, air and walls are smooth: they do not turn grains.
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

/// Gives every grain a spin of zero.
void let_grains_turn(SandState& sand);
/// w += (dt/2) T/I with the torques of the last call of SandPairs::forces.
void half_turn(SandState& sand, double dt, int threads = 1);
/// J of one grain.
double rotation_energy(const SandState& sand, std::size_t grain);
/// J of the simulated part, summed in a fixed order; 0 where grains do not turn.
double rotation_energy(const SandState& sand);

}  // namespace standoff::particles
