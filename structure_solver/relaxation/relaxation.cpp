#include "structure_solver/relaxation/relaxation.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/core.h>

#include "coupling/base/stop.hpp"
#include "structure_solver/relaxation/damped_motion.hpp"
#include "structure_solver/relaxation/implicit_relaxation.hpp"
#include "structure_solver/relaxation/leapfrog_relaxation.hpp"
#include "structure_solver/relaxation/static_polish.hpp"
#include "structure_solver/relaxation/vibration.hpp"

namespace standoff::structure {
namespace {

void say(RelaxationResult& result, const std::string& text) {
  if (text.empty()) return;
  result.message += (result.message.empty() ? "" : "; ") + text;
}

LowestMode find_lowest_mode(StiffnessFactor& stiffness, std::span<const double> v, RelaxationResult& result) {
  const LowestMode mode = lowest_mode(stiffness, v);
  result.first_frequency = mode.angular_frequency / (2.0 * std::numbers::pi);
  result.negative_modes = mode.negative_modes;
  if (mode.shift > 0.0)
    say(result,
        fmt::format(
            "the stiffness at the start is not positive definite ({} negative eigenvalue(s)); shifted by {:.3g} "
            "rad2/s2 to find the lowest positive frequency",
            mode.negative_modes, mode.shift));
  return mode;
}

/// Damped motion until it has settled or its time is over, by whatever integrator still works.
void move(DampedMotion& motion, StiffnessFactor& stiffness, bool& explicitly, RelaxationResult& result) {
  const Stopwatch wall;
  if (!explicitly) {
    const ImplicitEnd end = run_implicit(motion, stiffness);
    result.linear_iterations += end.linear_iterations;
    say(result, end.message);
    if (end.gave_up) {
      explicitly = true;
      stiffness.replace(motion.problem().stiffness(motion.displacement()));
      say(result, "went on with the explicit damped leapfrog");
    }
  }
  if (explicitly) run_leapfrog(motion, stiffness);
  motion.book_damping();
  result.wall_relax += wall.seconds();
}

void static_solve(DampedMotion& motion, StiffnessFactor& stiffness, RelaxationResult& result) {
  const Stopwatch wall;
  const PolishEnd end = polish(motion, stiffness);
  result.linear_iterations += end.linear_iterations;
  result.polished = result.polished || end.accepted;
  result.polish_difference += end.moved;
  say(result, end.message);
  motion.book_damping();
  result.wall_polish += wall.seconds();
}

void measure(DampedMotion& motion, const StiffnessFactor& stiffness, RelaxationResult& result) {
  const RestMonitor& monitor = motion.monitor();
  result.kinetic_ratio = monitor.kinetic_ratio();
  result.drift_per_period = monitor.drift();
  result.residual = motion.residual();
  result.plastic_work_gained = motion.plastic_work_gained();
  result.plastic_work_last_period = monitor.plastic_work_gained();
  result.simulated_time = motion.time();
  result.steps = motion.steps();
  result.force_calls = motion.force_calls();
  result.factorisations = stiffness.factorisations();
  result.damping_energy = motion.damping_energy();
  result.damping_integral = motion.damping_integral();
  const std::string missing = monitor.shortcomings(result.residual);
  result.at_rest = missing.empty();
  if (!result.at_rest)
    say(result, fmt::format("not at rest after {:.4g} ms of damped motion: {}", motion.time() * 1e3, missing));
}

}  // namespace

RelaxationResult relax_to_rest(RelaxationProblem& problem, const RelaxationOptions& options) {
  RelaxationResult result;
  const Stopwatch wall;
  const auto size = static_cast<std::size_t>(problem.dofs());
  std::vector<double> u(size), v(size);
  problem.get_state(u, v);
  StiffnessFactor stiffness(problem.stiffness(u), problem.mass());
  const LowestMode mode = find_lowest_mode(stiffness, v, result);
  DampedMotion motion(problem, options, mode.angular_frequency);
  result.wall_relax = wall.seconds();

  bool explicitly = options.method == RelaxationMethod::explicit_leapfrog;
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    move(motion, stiffness, explicitly, result);
    if (!motion.settled() || !options.polish) break;
    const double before = result.polish_difference;
    static_solve(motion, stiffness, result);
    // A polish that failed, or moved the centre by more than rest allows, found the motion not finished: watch once
    // more.
    const bool small = result.polish_difference - before < options.rest_drift;
    if (small && motion.residual() < options.rest_residual) break;
    if (round + 1 < rounds) motion.watch_again();
  }
  measure(motion, stiffness, result);
  return result;
}

}  // namespace standoff::structure
