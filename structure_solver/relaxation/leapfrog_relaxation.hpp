#pragma once
// Explicit damped leapfrog: the reference for the implicit motion, and what it falls back to. Central differences with
// the damping centred in time (Underwood, Dynamic relaxation, 1983, eq. 2.7), so damping does not lower the stability
// limit:
//
//   v(n+1/2) = ((1 - alpha dt/2) v(n-1/2) - dt M^-1 f(u_n)) / (1 + alpha dt/2),   u(n+1) = u_n + dt v(n+1/2)
//
// Stable for dt < 2 / omega_max; 0.85 of it is used.
#include "structure_solver/relaxation/damped_motion.hpp"
#include "structure_solver/relaxation/stiffness_factor.hpp"

namespace standoff::structure {

/// 0.85 of the stability limit of K.
double stable_explicit_step(const StiffnessFactor& stiffness);

/// Moves on until motion.finished(). Throws Stop(guard) if an element inverts.
void run_leapfrog(DampedMotion& motion, const StiffnessFactor& stiffness);

}  // namespace standoff::structure
