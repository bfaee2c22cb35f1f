#pragma once
// Brings a deformed, ringing structure to rest and certifies it.
#include <functional>
#include <string>

#include "structure_solver/relaxation/relaxation_problem.hpp"

namespace standoff::structure {

enum class RelaxationMethod {
  implicit,           // CVODE, falling back to the leapfrog if it cannot go on
  explicit_leapfrog,  // the reference: slow, robust, same kernel as the loading phase
};

struct RelaxationOptions {
  double peak_kinetic_energy = 0.0;  // J, largest of the loading phase; kinetic_ratio refers to it
  double time_cap = 30e-3;           // s of simulated time
  double rest_residual = 1.0;        // N
  double rest_kinetic_ratio = 1e-9;
  double rest_drift = 2e-6;  // m per period
  /// Called while it works, also to keep heartbeats going.
  std::function<void(double time, double deflection, double kinetic_ratio)> progress;

  RelaxationMethod method = RelaxationMethod::implicit;
  double damping_factor = 1.0;  // alpha = damping_factor * 2 omega_1; too small rings on, too large creeps
  /// Of CVODE. 1e-2 ends in a wrong rest state, because plastic flow depends on the path.
  double relative_tolerance = 1e-4;
  double explicit_step = 0.0;     // s, of the leapfrog; 0: from the highest frequency
  bool polish = true;             // static Newton solve at the end
  double polish_residual = 1e-3;  // N, what the polish aims at; rounding leaves about this much
  long polish_iterations = 50;
};

/// The certificate of the contract (run.json relaxation.*), and what was done.
struct RelaxationResult {
  bool at_rest = false;
  double kinetic_ratio = 0.0, residual = 0.0, drift_per_period = 0.0, polish_difference = 0.0;
  double first_frequency = 0.0;  // Hz, of the deformed structure; damping is alpha = 2 omega_1
  double simulated_time = 0.0, wall_relax = 0.0, wall_polish = 0.0;
  long force_calls = 0;
  double plastic_work_gained = 0.0;  // J
  std::string message;               // what the solvers did and said, in words

  bool polished = false;                  // a static solve was accepted
  double plastic_work_last_period = 0.0;  // J
  double damping_energy = 0.0;            // J, taken out in all: booked, so that the model's ledger closes
  double damping_integral = 0.0;          // J, integral of alpha v.M v; the rest is what the time integration took
  long negative_modes = 0;                // negative eigenvalues of the stiffness at the start
  long steps = 0, factorisations = 0, linear_iterations = 0;
};

RelaxationResult relax_to_rest(RelaxationProblem& problem, const RelaxationOptions& options);

}  // namespace standoff::structure
