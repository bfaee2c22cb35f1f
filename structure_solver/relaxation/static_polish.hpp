#pragma once
// Static equilibrium f(u) = 0 from a structure that is almost at rest, by KINSOL: Newton with line search, GMRES for
// each step, preconditioned by the Cholesky factor of K at the starting state (without it KINSOL fails: the stiffest
// and softest modes are 1e7 apart). Removes the last micrometres of a creeping soft mode and certifies the residual.
//
// Nothing is written while it iterates. The result is committed only if the measured residual dropped; else
// displacement, velocity and history keep their bits. Velocity becomes zero.
#include <string>

#include "structure_solver/relaxation/damped_motion.hpp"
#include "structure_solver/relaxation/stiffness_factor.hpp"

namespace standoff::structure {

struct PolishEnd {
  bool accepted = false;
  double moved = 0.0;                            // m, of the centre
  double residual_before = 0.0, residual = 0.0;  // N; `residual` is that of the state left behind
  long negative_modes = 0;                       // negative eigenvalues of K: an unstable equilibrium
  long linear_iterations = 0;
  std::string message;
};

/// `stiffness` receives K at the present state.
PolishEnd polish(DampedMotion& motion, StiffnessFactor& stiffness);

}  // namespace standoff::structure
