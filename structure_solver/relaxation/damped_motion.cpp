#include "structure_solver/relaxation/damped_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/core.h>

#include "coupling/base/stop.hpp"

namespace standoff::structure {
namespace {

constexpr double periods_to_review = 4.0;  // a critically damped mode has lost all but e^-25 by then
constexpr int most_reviews = 3;
constexpr double little_energy = 1e-4;  // of the peak: nothing swings that could still flow

double largest(std::span<const double> values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

RestLimits limits_of(const RelaxationOptions& options) {
  RestLimits limits;
  limits.kinetic_ratio = options.rest_kinetic_ratio;
  limits.drift = options.rest_drift;
  limits.residual = options.rest_residual;
  return limits;
}

}  // namespace

DampedMotion::DampedMotion(RelaxationProblem& problem, const RelaxationOptions& options, double omega_1)
    : problem_(problem),
      options_(options),
      u_(static_cast<std::size_t>(problem.dofs())),
      v_(u_.size()),
      force_(u_.size()),
      mass_(problem.mass().begin(), problem.mass().end()),
      alpha_(options.damping_factor * 2.0 * omega_1),
      period_(2.0 * std::numbers::pi / omega_1),
      monitor_(limits_of(options), period_, options.peak_kinetic_energy),
      tolerance_(options.relative_tolerance),
      next_review_(periods_to_review * period_) {
  problem_.get_state(u_, v_);
  length_ = std::max({largest(u_), largest(v_) / omega_1, 1e-12});
  plastic_at_start_ = plastic_at_booking_ = problem_.plastic_work();
  energy_at_start_ = energy_at_booking_ = mechanical_energy();
  damping_power_ = 2.0 * alpha_ * kinetic_energy(v_);
  monitor_.observe(0.0, problem_.centre_deflection(u_), kinetic_energy(v_), plastic_at_start_);
}

double DampedMotion::kinetic_energy(std::span<const double> v) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += mass_[i] * v[i] * v[i];
  return 0.5 * sum;
}

bool DampedMotion::evaluate(std::span<const double> u, double dt, std::span<double> f) {
  ++force_calls_;
  if (since_progress_.seconds() > 0.1) report_progress();
  if (!problem_.internal_force(u, dt, f)) return false;
  return std::all_of(f.begin(), f.end(), [](double value) { return std::isfinite(value); });
}

bool DampedMotion::force(std::span<const double> u, double time, std::span<double> f) {
  // dt = 0 would mean "no rate effect", a jump of the stress at the accepted state itself; a very short time means "no
  // flow yet".
  return evaluate(u, std::max(time - time_, 1e-6 * period_), f);
}

bool DampedMotion::static_force(std::span<const double> u, std::span<double> f) {
  return evaluate(u, 0.0, f);
}

double DampedMotion::residual() {
  return static_force(u_, force_) ? largest(force_) : std::numeric_limits<double>::infinity();
}

void DampedMotion::accept(double time, std::span<const double> u, std::span<const double> v) {
  const double dt = time - time_;
  problem_.commit(u, dt);
  std::copy(u.begin(), u.end(), u_.begin());
  std::copy(v.begin(), v.end(), v_.begin());
  time_ = time;
  ++steps_;
  const double kinetic = kinetic_energy(v_), power = 2.0 * alpha_ * kinetic;
  damping_integral_ += 0.5 * dt * (damping_power_ + power);
  damping_power_ = power;
  monitor_.observe(time_, problem_.centre_deflection(u_), kinetic, problem_.plastic_work());
  if (time_ >= next_energy_check_) check_energy();
  if (since_progress_.seconds() > 0.02) report_progress();
}

void DampedMotion::accept_static(std::span<const double> u) {
  problem_.commit(u, 0.0);
  std::copy(u.begin(), u.end(), u_.begin());
  std::fill(v_.begin(), v_.end(), 0.0);
  damping_power_ = 0.0;
  publish();
}

void DampedMotion::publish() {
  problem_.set_state(u_, v_);
}

/// Nothing drives the structure, so what it holds plus what it lost cannot exceed what it started with.
void DampedMotion::check_energy() {
  next_energy_check_ = time_ + period_ / 32.0;
  const double gained = mechanical_energy() + plastic_work_gained() + damping_integral_ - energy_at_start_;
  const double allowed = energy_allowance_ * std::max(options_.peak_kinetic_energy, std::abs(energy_at_start_));
  if (!(gained <= allowed + 1e-12))
    throw Stop(
        ExitCode::guard,
        fmt::format(
            "relaxation: energy grows: {:.4g} J more than at its start, {:.3g} ms ago (step {}, limit {:.3g} J); "
            "the time integration is unstable (a shorter step or a smaller tolerance helps), or the force is "
            "not the derivative of the energy",
            gained, time_ * 1e3, steps_, allowed));
}

bool DampedMotion::finished() {
  if (settled_ || review_due_ || time_ >= options_.time_cap) return true;
  if (!monitor_.still()) {
    still_since_ = -1.0;
    review_due_ = reviews_ < most_reviews && time_ >= next_review_ && monitor_.kinetic_ratio() < little_energy;
    return review_due_;
  }
  if (still_since_ < 0.0) still_since_ = time_;
  if (time_ < next_residual_check_) return false;
  next_residual_check_ = time_ + period_ / 16.0;
  settled_ =
      (monitor_.quiet() && residual() < options_.rest_residual) || (options_.polish && time_ - still_since_ > period_);
  return settled_;
}

void DampedMotion::retune(double omega_1) {
  alpha_ = options_.damping_factor * 2.0 * omega_1;
  period_ = 2.0 * std::numbers::pi / omega_1;
  damping_power_ = 2.0 * alpha_ * kinetic_energy(v_);
  ++reviews_;
  watch_again();
}

void DampedMotion::watch_again() {
  settled_ = review_due_ = false;
  still_since_ = -1.0;
  next_review_ = time_ + periods_to_review * period_;
  monitor_.restart(period_);
  monitor_.observe(time_, problem_.centre_deflection(u_), kinetic_energy(v_), problem_.plastic_work());
}

void DampedMotion::book_damping() {
  const double energy = mechanical_energy(), plastic = problem_.plastic_work();
  const double removed = energy_at_booking_ - energy - (plastic - plastic_at_booking_);
  energy_at_booking_ = energy;
  plastic_at_booking_ = plastic;
  damping_energy_ += removed;
  problem_.book_damping(removed);
}

void DampedMotion::report_progress() {
  since_progress_ = Stopwatch();
  if (options_.progress) options_.progress(time_, problem_.centre_deflection(u_), monitor_.kinetic_ratio());
}

}  // namespace standoff::structure
