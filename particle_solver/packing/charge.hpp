#pragma once
// The explosive as a gas of spheres that wait for the detonation front [Borvik 2011, sec. 3.2].
//
// - number: charge.particles / copies spheres, copies = 4 for the quarter x >= 0, y >= 0, else 1
// - radius: r = (3 fill V0 / (4 pi N))^(1/3), V0 = mass / density of the explosive: the co-volume is the spheres' size
// - positions: centres inside the ball or the cylinder of the charge, no two spheres overlap
// - velocities: Maxwell-Boltzmann in antithetic pairs v, -v of neighbours: no momentum, locally and in the sum
// - energy: mass E0 / density in all; the translational share is xi = 3 (gamma - 1) / 2 exactly, in the sum
// - internal: Gamma(zeta/2) distributed, scaled to the exact sum: what the exchange of larsen_borgnakke.hpp keeps
// - release: t = L / D, L the distance from the detonator
//
// A quiet start: positions come from a low-discrepancy sequence with a random shift and jitter, so the density has none
// of the long waves of independent random points; different seeds give different samples of the same isotropic body.
#include <cstdint>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

/// Builds the simulated part of the charge around `centre` [m] (on the mirror corner x = y = 0 if copies is 4).
GasState build_charge(const ChargeSpec& charge, const Vec3& centre, int copies, std::uint64_t seed);

}  // namespace standoff::particles
