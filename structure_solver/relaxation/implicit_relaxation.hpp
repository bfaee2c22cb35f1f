#pragma once
// Damped motion by CVODE. State y = (u, v), 2 n numbers:
//
//   u' = v,   v' = -M^-1 f(u) - alpha v
//
// BDF of order at most 2: higher orders are unstable for lightly damped vibration (A-stable only to order 2). Each
// Newton matrix I - gamma J is solved by GMRES; J times a vector is a difference of two force evaluations.
// Preconditioner: the block system with J's stiffness K taken at some earlier state and gamma at an earlier step,
//
//   [   1        -gamma      ] [x_u]   [r_u]        (gamma^2 K + (1 + gamma alpha) M) x_u = (1 + gamma alpha) M r_u +
//   gamma M r_v [ gamma M^-1 K  1+gamma alpha ] [x_v] = [r_v]   x_v = (x_u - r_u) / gamma
//
// one symmetric solve. Frozen K and gamma cost GMRES iterations, not accuracy: for a gamma off by r the preconditioned
// spectrum lies between 1 and r^2. A factorisation costs as much as some 50 to 250 solves, so the factor is renewed
// only once the iterations wasted since the last one add up to that price: never more than twice the cost of the best
// choice.
#include <string>

#include "structure_solver/relaxation/damped_motion.hpp"
#include "structure_solver/relaxation/stiffness_factor.hpp"

namespace standoff::structure {

struct ImplicitEnd {
  bool gave_up = false;  // continue explicitly from the last accepted state
  std::string message;   // what CVODE said and what was done about it; empty if all went well
  long linear_iterations = 0;
};

/// Moves on until motion.finished() or CVODE is beyond help. `stiffness` holds K at the present state.
ImplicitEnd run_implicit(DampedMotion& motion, StiffnessFactor& stiffness);

}  // namespace standoff::structure
