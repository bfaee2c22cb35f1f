#pragma once
// The damped motion of a structure towards rest, free of any particular time integration:
//
//   M a + alpha M v + f(u; history) = 0,   alpha = damping_factor * 2 omega_1
//
// Holds the last accepted state and is the only place that writes history while the structure moves: an integrator
// evaluates force() as often as it likes and calls accept() once per step it stands by. Energies are booked here as
// well.
#include <string>
#include <vector>

#include "coupling/base/stage_timer.hpp"
#include "structure_solver/relaxation/relaxation.hpp"
#include "structure_solver/relaxation/rest_monitor.hpp"

namespace standoff::structure {

class DampedMotion {
 public:
  /// Takes u and v from the problem. omega_1 [rad/s]: lowest frequency of the starting state.
  DampedMotion(RelaxationProblem& problem, const RelaxationOptions& options, double omega_1);

  RelaxationProblem& problem() { return problem_; }
  const RelaxationOptions& options() const { return options_; }
  std::span<const double> mass() const { return mass_; }
  std::span<const double> displacement() const { return u_; }
  std::span<const double> velocity() const { return v_; }
  double time() const { return time_; }  // of the last accepted state
  double alpha() const { return alpha_; }
  double period() const { return period_; }
  /// Size of the displacements [m], the scale of tolerances and differences.
  double length_scale() const { return length_; }
  long steps() const { return steps_; }

  /// f at u at `time`, the rate taken over the time since the last accepted step. False: inverted element or not
  /// finite.
  bool force(std::span<const double> u, double time, std::span<double> f);
  /// f at u without rate effects.
  bool static_force(std::span<const double> u, std::span<double> f);
  /// Largest component of f(u) without rate effects [N], infinite if there is no force.
  double residual();

  /// Commits the state at `time`, observes it, books the damping; throws Stop(guard) if energy appears from nowhere.
  void accept(double time, std::span<const double> u, std::span<const double> v);
  /// Commits a static state, v = 0; time stands still.
  void accept_static(std::span<const double> u);

  /// Hands the last accepted displacement and velocity to the problem; a model may have to evaluate forces for that, so
  /// it is done when the motion pauses, not every step.
  void publish();

  /// The motion has settled, its time is up, or it should be reviewed.
  bool finished();
  /// Still enough for the static solve: kinetic energy and drift are at rest, and so are plastic work and residual, or
  /// one more period did not bring them there. A rate-dependent metal creeps for ever at forces that a static solve
  /// takes away at once.
  bool settled() const { return settled_; }
  /// Four periods passed with little kinetic energy but no rest: frequency and tolerance may no longer suit. Three
  /// times at most.
  bool review_due() const { return review_due_; }
  /// New damping and period for the frequency omega_1 of the present state.
  void retune(double omega_1);
  void tighten() { tolerance_ *= 0.1; }
  double tolerance() const { return tolerance_; }
  /// Ask for one more period before the motion counts as settled.
  void watch_again();
  const RestMonitor& monitor() const { return monitor_; }

  /// Energy that may appear within the motion before it counts as unstable, over the peak kinetic energy.
  void allow_energy_error(double fraction) { energy_allowance_ = fraction; }
  /// Books what damping took out since the start or the last call.
  void book_damping();
  long force_calls() const { return force_calls_; }
  double damping_energy() const { return damping_energy_; }
  double damping_integral() const { return damping_integral_; }
  double plastic_work_gained() const { return problem_.plastic_work() - plastic_at_start_; }

 private:
  double kinetic_energy(std::span<const double> v) const;
  double mechanical_energy() { return kinetic_energy(v_) + problem_.elastic_energy(u_); }
  bool evaluate(std::span<const double> u, double dt, std::span<double> f);
  void check_energy();
  void report_progress();

  RelaxationProblem& problem_;
  const RelaxationOptions& options_;
  std::vector<double> u_, v_, force_, mass_;
  double alpha_, period_, length_ = 0.0, time_ = 0.0;
  RestMonitor monitor_;
  double tolerance_;
  bool settled_ = false, review_due_ = false;
  double still_since_ = -1.0, next_residual_check_ = 0.0, next_energy_check_ = 0.0, next_review_;
  int reviews_ = 0;
  long steps_ = 0, force_calls_ = 0;
  double plastic_at_start_, plastic_at_booking_, energy_at_start_, energy_at_booking_;
  double damping_power_ = 0.0, damping_integral_ = 0.0, damping_energy_ = 0.0;
  double energy_allowance_ = 0.05;
  Stopwatch since_progress_;
};

}  // namespace standoff::structure
