#include "structure_solver/models/plate_shell/shell_plate.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>

#include "structure_solver/models/plate_hex64/plate_solid.hpp"

namespace standoff::structure {
namespace {

constexpr long steps_between_estimates = 50;
constexpr long elements_per_thread = 64;  // below this, starting a thread costs more than it saves

/// Inertia of a slip over the mass of its node: rho h^3 / 12 per area, over (h/2)^2.
constexpr double slip_inertia = 1.0 / 3.0;

NodalState at_rest(const std::vector<double>& mass, double factor, const std::vector<std::uint8_t>& fixed) {
  NodalState s;
  const std::size_t n = mass.size();
  s.u.resize(n), s.v.resize(n), s.internal.resize(n), s.external.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    s.mass.push_back(factor * mass[i]);
    const double inverse = 1.0 / s.mass[i];
    s.inverse_mass.push_back(
        {fixed[i] & fixed_x ? 0.0 : inverse, fixed[i] & fixed_y ? 0.0 : inverse, fixed[i] & fixed_z ? 0.0 : inverse});
  }
  return s;
}

double kinetic_of(const NodalState& s) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.v.size(); ++i) sum += 0.5 * s.mass[i] * squared_norm(s.v[i]);
  return sum;
}

}  // namespace

ShellPlate::ShellPlate(const CaseSpec& spec, int threads)
    : mesh_(make_shell_mesh(mesh_options(spec))),
      threads_(
          static_cast<int>(std::clamp<long>(threads, 1, std::max(1L, mesh_.element_count() / elements_per_thread)))),
      forces_(mesh_, metal_parameters(spec.plate.material), metal_effects(spec), threads_),
      translation_(at_rest(mesh_.mass, 1.0, mesh_.fixed)),
      slip_(at_rest(mesh_.mass, slip_inertia, mesh_.fixed_slip)) {
  rest_step_ = rest_step();
  stable_step_ = step_safety * rest_step_;
}

/// 2 / omega_max of one free element at rest, with the quarter of its mass at each node: a bound for the assembled
/// plate (Irons' theorem). All elements are alike.
double ShellPlate::rest_step() {
  ShellForce::ElementMatrix k = forces_.element_stiffness(0, translation_.u, slip_.u);
  Eigen::Map<Eigen::MatrixXd> matrix(k.data(), 20, 20);
  const std::array<Vec3, 4> at = mesh_.corners(0);
  const double quarter =
      0.25 * mesh_.options.density * mesh_.options.size.z * (at[2].x - at[0].x) * (at[2].y - at[0].y);
  Eigen::VectorXd scale(20);
  for (int i = 0; i < 20; ++i) scale[i] = 1.0 / std::sqrt(quarter * (i % 5 < 3 ? 1.0 : slip_inertia));
  const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return 2.0 / std::sqrt(solver.eigenvalues().maxCoeff());
}

double ShellPlate::kinetic() const {
  return kinetic_of(translation_) + kinetic_of(slip_);
}

Stop ShellPlate::broken(const ForceSums& sums) const {
  const std::array<Vec3, 4> at = mesh_.corners(static_cast<std::size_t>(sums.broken_element));
  const Vec3 centre = 0.5 * (at[0] + at[2]);
  char text[640];
  std::snprintf(
      text, sizeof text,
      "structure: shell element %ld turned inside out (det F <= 0, turned over, or not finite)\n"
      "  at t = %.4g us, element centre at rest (%.1f, %.1f) mm, last step %.4g us, stable step %.4g us\n"
      "  the load bends or squeezes one element beyond its shape: use more elements (plate.elements), a larger\n"
      "  stand-off, or a shorter coupling.window if the step above is larger than the stable one",
      sums.broken_element, 1e6 * time_, 1e3 * centre.x, 1e3 * centre.y, 1e6 * last_dt_, 1e6 * stable_step_);
  return Stop(ExitCode::guard, text);
}

void ShellPlate::step_back(double dt) {
  for (NodalState* s : {&translation_, &slip_})
    for (std::size_t i = 0; i < s->u.size(); ++i) s->u[i] += -dt * s->v[i];
  time_ -= dt;
}

void ShellPlate::book(const HalfStepSums& sums) {
  books_.external_work += sums.work, books_.received += sums.received, books_.of_supports += sums.of_supports;
}

void ShellPlate::kick_and_drift_nodes(double dt) {
  book(kick_and_drift(translation_, dt, threads_));
  kick_and_drift(slip_, dt, threads_);  // no load, and what its supports carry are couples
  time_ += dt;
  last_dt_ = dt;
}

void ShellPlate::take(const ForceSums& sums) {
  elastic_ = sums.elastic;
  books_.inelastic_work += sums.inelastic;
}

void ShellPlate::update_elements(double dt) {
  const ForceSums sums = forces_.evaluate(translation_.u, slip_.u, {dt, true}, true);
  if (sums.broken_element >= 0) {
    const Stop cause = broken(sums);
    step_back(dt);
    throw cause;
  }
  take(sums);
  if (++steps_ % steps_between_estimates == 0)
    stable_step_ = step_safety * rest_step_ * forces_.shape_factor(translation_.u, slip_.u);
}

void ShellPlate::kick_nodes(double dt) {
  book(kick_with(translation_, dt, threads_, [&](std::size_t i) { return forces_.on_displacement(i); }));
  kick_with(slip_, dt, threads_, [&](std::size_t i) { return forces_.on_slip(i); });
}

void ShellPlate::collect_internal_force() {
  for (std::size_t i = 0; i < translation_.internal.size(); ++i) {
    translation_.internal[i] = forces_.on_displacement(i);
    slip_.internal[i] = forces_.on_slip(i);
  }
}

void ShellPlate::set_motion(const Nodal& at, const Nodal& velocity) {
  translation_.u = at.u, slip_.u = at.slip;
  translation_.v = velocity.u, slip_.v = velocity.slip;
  const ForceSums sums = forces_.evaluate(translation_.u, slip_.u, {0.0, false}, false);
  if (sums.broken_element >= 0) throw broken(sums);
  elastic_ = sums.elastic;
  collect_internal_force();
  stable_step_ = step_safety * rest_step_ * forces_.shape_factor(translation_.u, slip_.u);
}

void ShellPlate::commit(const Nodal& at, double dt) {
  translation_.u = at.u, slip_.u = at.slip;
  const ForceSums sums = forces_.evaluate(translation_.u, slip_.u, {dt, true}, true);
  if (sums.broken_element >= 0) throw broken(sums);
  take(sums);
  collect_internal_force();
}

}  // namespace standoff::structure
