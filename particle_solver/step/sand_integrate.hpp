#pragma once
// Stage sand_integrate: the kicks of velocity Verlet, and the drift where no gas does it.
//   v += (dt/2) F/m;   x += dt v
// Source: Swope, Andersen, Berens, Wilson, J. Chem. Phys. 76, 637 (1982), eqs. 1-3, as two half kicks around a drift.
// Stable and accurate steps: SandPairs::stable_step.
#include "particle_solver/state/media.hpp"
#include "particle_solver/step/sand_pairs.hpp"

namespace standoff::particles {

/// v += (dt/2) F/m with the forces of the last call of SandPairs::forces.
void half_kick(SandState& sand, double dt, int threads = 1);
/// x += dt v.
void drift(SandState& sand, double dt, int threads = 1);
/// One step of sand alone: half kick, drift, forces, half kick. Forces must have been set once before.
void sand_step(SandState& sand, SandPairs& pairs, double dt, int threads = 1);
/// J of the simulated part, summed in a fixed order.
double kinetic_energy(const SandState& sand);
/// kg m/s of the simulated part, summed in a fixed order.
Vec3 momentum(const SandState& sand);
/// Equal grains at rest, ids 0, 1, 2, ...
SandState make_grains(std::vector<Vec3> positions, double radius, double mass);

}  // namespace standoff::particles
