#include "structure_solver/relaxation/relaxation.hpp"

#include <algorithm>
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

/// Lowest angular frequency that damping may follow [rad/s]. Kinetic energy falls as exp(-alpha t), alpha = 2 omega:
/// damping must bring it to the rest ratio within half of the time there is. Near a change of stability the smallest
/// positive eigenvalue may be next to zero and says nothing of what swings: within a quarter then.
double slowest_frequency(const RelaxationOptions& options, bool unstable) {
  const double share = unstable ? 0.25 : 0.5;
  return 0.5 * std::log(1.0 / options.rest_kinetic_ratio) / (share * options.time_cap);
}

LowestMode find_lowest_mode(StiffnessFactor& stiffness, std::span<const double> v, const RelaxationOptions& options,
                            RelaxationResult& result) {
  LowestMode mode = lowest_mode(stiffness, v);
  result.first_frequency = mode.angular_frequency / (2.0 * std::numbers::pi);
  result.negative_modes = mode.negative_modes;
  if (mode.shift > 0.0)
    say(result,
        fmt::format(
            "the stiffness at the start is not positive definite ({} negative eigenvalue(s)); shifted by {:.3g} "
            "rad2/s2 to find the lowest positive frequency",
            mode.negative_modes, mode.shift));
  const double slowest = slowest_frequency(options, mode.negative_modes > 0);
  if (mode.angular_frequency < slowest) {
    mode.angular_frequency = slowest;
    say(result, fmt::format("damping follows {:.4g} Hz, or it would not come to rest in time",
                            slowest / (2.0 * std::numbers::pi)));
  }
  return mode;
}

/// Frequency of the present state: if it is another, damping follows it; if not, noise of the integration may be what
/// is left.
void review(DampedMotion& motion, StiffnessFactor& stiffness, RelaxationResult& result) {
  stiffness.replace(motion.problem().stiffness(motion.displacement()));
  const LowestMode mode = lowest_mode(stiffness, motion.velocity());
  const double now = std::max(mode.angular_frequency, slowest_frequency(motion.options(), mode.negative_modes > 0));
  const double before = 2.0 * std::numbers::pi / motion.period();
  const bool other = std::abs(now - before) > 0.2 * before;
  if (!other) motion.tighten();
  motion.retune(other ? now : before);
  say(result,
      other ? fmt::format("at {:.4g} ms damping was set to the frequency of the present state, {:.4g} Hz",
                          motion.time() * 1e3, now / (2.0 * std::numbers::pi))
            : fmt::format("at {:.4g} ms the tolerance was lowered to {:.1g}", motion.time() * 1e3, motion.tolerance()));
}

/// Damped motion by whatever integrator still works, until it settles, its time is over or a review is due.
void move(DampedMotion& motion, StiffnessFactor& stiffness, bool& explicitly, RelaxationResult& result) {
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
}

void settle(DampedMotion& motion, StiffnessFactor& stiffness, bool& explicitly, RelaxationResult& result) {
  const Stopwatch wall;
  move(motion, stiffness, explicitly, result);
  while (motion.review_due()) {
    review(motion, stiffness, result);
    move(motion, stiffness, explicitly, result);
  }
  motion.publish();
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

/// Damped motion and static solve, again if the solve found the motion unfinished: if it failed, moved the centre by
/// more than rest allows, or let the metal flow.
void come_to_rest(DampedMotion& motion, StiffnessFactor& stiffness, RelaxationResult& result) {
  const RelaxationOptions& options = motion.options();
  bool explicitly = options.method == RelaxationMethod::explicit_leapfrog;
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    settle(motion, stiffness, explicitly, result);
    if (!motion.settled() || !options.polish) break;
    const double moved = result.polish_difference, flowed = motion.plastic_work_gained();
    static_solve(motion, stiffness, result);
    const bool small = result.polish_difference - moved < options.rest_drift;
    const bool elastic = motion.plastic_work_gained() - flowed <= 1e-6 * motion.problem().plastic_work();
    if (small && elastic && motion.monitor().quiet() && motion.residual() < options.rest_residual) break;
    if (round + 1 < rounds) motion.watch_again();
  }
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
  const LowestMode mode = find_lowest_mode(stiffness, v, options, result);
  DampedMotion motion(problem, options, mode.angular_frequency);
  result.wall_relax = wall.seconds();

  try {
    come_to_rest(motion, stiffness, result);
  } catch (...) {
    motion.publish();  // whoever reports the failure finds displacements that belong to the history
    throw;
  }
  measure(motion, stiffness, result);
  return result;
}

}  // namespace standoff::structure
