#include "structure_solver/relaxation/leapfrog_relaxation.hpp"

#include <vector>

#include <fmt/core.h>

#include "coupling/base/stop.hpp"
#include "structure_solver/relaxation/vibration.hpp"

namespace standoff::structure {
namespace {

[[noreturn]] void stop_for_force(const DampedMotion& motion) {
  throw Stop(ExitCode::guard,
             fmt::format("relaxation: no internal force {:.4g} ms after its start (an element inverted, or a "
                         "number is not finite); the structure was destroyed or the step is too long",
                         motion.time() * 1e3));
}

}  // namespace

double stable_explicit_step(const StiffnessFactor& stiffness) {
  return 0.85 * 2.0 / highest_frequency(stiffness);
}

void run_leapfrog(DampedMotion& motion, const StiffnessFactor& stiffness) {
  // Displacement and velocity belong to the same time only on average: near the stability limit the energy of the
  // stiffest modes, read from them, swings by its own size. An instability grows past any bound within some ten steps.
  motion.allow_energy_error(1.0);
  const std::span<const double> mass = motion.mass();
  const std::size_t size = mass.size();
  const double asked = motion.options().explicit_step;
  const double dt = asked > 0.0 ? asked : stable_explicit_step(stiffness), alpha = motion.alpha();
  const double keep = (1.0 - 0.5 * alpha * dt) / (1.0 + 0.5 * alpha * dt), push = dt / (1.0 + 0.5 * alpha * dt);
  std::vector<double> u(motion.displacement().begin(), motion.displacement().end());
  std::vector<double> v(motion.velocity().begin(), motion.velocity().end());
  std::vector<double> half(size), force(size);

  if (!motion.force(u, motion.time(), force)) stop_for_force(motion);
  for (std::size_t i = 0; i < size; ++i) half[i] = v[i] - 0.5 * dt * (force[i] / mass[i] + alpha * v[i]);
  bool first = true;
  while (!motion.finished()) {
    const double time = motion.time() + dt;
    if (!first)
      for (std::size_t i = 0; i < size; ++i) half[i] = keep * half[i] - push * force[i] / mass[i];
    for (std::size_t i = 0; i < size; ++i) u[i] += dt * half[i];
    if (!motion.force(u, time, force)) stop_for_force(motion);
    for (std::size_t i = 0; i < size; ++i) v[i] = 0.5 * (half[i] + keep * half[i] - push * force[i] / mass[i]);
    motion.accept(time, u, v);
    first = false;
  }
}

}  // namespace standoff::structure
