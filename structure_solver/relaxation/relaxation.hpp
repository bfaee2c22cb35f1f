#pragma once
// Brings a deformed, ringing structure to rest and certifies it.
#include <functional>
#include <string>

#include "structure_solver/relaxation/relaxation_problem.hpp"

namespace standoff::structure {

struct RelaxationOptions {
  double peak_kinetic_energy = 0.0;  // J, largest of the loading phase; kinetic_ratio refers to it
  double time_cap = 30e-3;           // s of simulated time
  double rest_residual = 1.0;        // N
  double rest_kinetic_ratio = 1e-9;
  double rest_drift = 2e-6;          // m per period
  std::function<void(double time, double deflection, double kinetic_ratio)> progress;  // also keeps heartbeats going
};

/// The certificate of the contract (run.json relaxation.*), and what was done.
struct RelaxationResult {
  bool at_rest = false;
  double kinetic_ratio = 0.0, residual = 0.0, drift_per_period = 0.0, polish_difference = 0.0;
  double first_frequency = 0.0;   // Hz, of the deformed structure; damping is alpha = 2 omega_1
  double simulated_time = 0.0, wall_relax = 0.0, wall_polish = 0.0;
  long force_calls = 0;
  double plastic_work_gained = 0.0;  // J
  std::string message;            // what the solvers said, in words
};

RelaxationResult relax_to_rest(RelaxationProblem& problem, const RelaxationOptions& options);

}  // namespace standoff::structure
