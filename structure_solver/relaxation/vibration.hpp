#pragma once
// Extreme frequencies of K x = omega^2 M x at a given state. The lowest sets the damping alpha = 2 omega_1 (critical
// for the softest mode) and the period over which rest is judged; the highest sets the stable step of the explicit
// leapfrog.
#include <span>

#include "structure_solver/relaxation/stiffness_factor.hpp"

namespace standoff::structure {

struct LowestMode {
  double angular_frequency = 0.0;  // rad/s
  long negative_modes = 0;         // K had this many negative eigenvalues: not a stable state
  double shift = 0.0;              // rad^2/s^2, added to K to factor it
  int iterations = 0;
};

/// Inverse iteration on a small block of vectors with Rayleigh-Ritz (subspace iteration: Bathe, Finite Element
/// Procedures, sec. 11.6). `guess`, for example the present velocity, is one of the starting vectors. The eigenvalue is
/// good to about 1e-4. If K is indefinite the smallest positive eigenvalue counts; if there is none, the size of the
/// negative one nearest to zero.
LowestMode lowest_mode(StiffnessFactor& factor, std::span<const double> guess);

/// Largest angular frequency by power iteration, with 5 % added because the iteration comes from below.
double highest_frequency(const StiffnessFactor& factor);

}  // namespace standoff::structure
