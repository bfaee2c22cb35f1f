#pragma once
// How far the sand has come: column sand_front_radius_m of histories.csv.
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

/// m from `centre`, within which 99 % of the grains lie that are still in the scene. Those that have left it (out of
/// the domain, or by drop_outgoing) are nowhere: the front of the others goes on. NaN when none are left.
double sand_front_radius(const SandState& sand, const Vec3& centre);

}  // namespace standoff::particles
