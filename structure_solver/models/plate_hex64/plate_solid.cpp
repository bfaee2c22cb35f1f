#include "structure_solver/models/plate_hex64/plate_solid.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "coupling/base/stop.hpp"

namespace standoff::structure {
namespace {

constexpr long steps_between_estimates = 50;
constexpr long elements_per_thread = 16;  // below this, starting a thread costs more than it saves

int useful_threads(const PlateMesh& mesh, int asked) {
  return static_cast<int>(std::clamp<long>(asked, 1, std::max(1L, mesh.element_count() / elements_per_thread)));
}

}  // namespace

MetalParameters metal_parameters(const MaterialSpec& s) {
  MetalParameters p;
  p.bulk = s.youngs_modulus / (3.0 * (1.0 - 2.0 * s.poissons_ratio));
  p.shear = s.youngs_modulus / (2.0 * (1.0 + s.poissons_ratio));
  p.flow = {s.A,
            s.B,
            s.n,
            s.C,
            s.reference_rate,
            s.m,
            s.room_temperature,
            s.melting_temperature,
            hardening_table(s.plastic_strain, s.flow_stress)};
  if (s.specific_heat > 0.0) p.heating = s.taylor_quinney / (s.density * s.specific_heat);
  p.expansion = 3.0 * s.thermal_expansion;
  return p;
}

MetalEffects metal_effects(const CaseSpec& spec) {
  const MaterialSpec& m = spec.plate.material;
  MetalEffects e;
  e.plasticity = spec.effect("plasticity") && m.law != MaterialLaw::elastic;
  const bool table = m.law == MaterialLaw::j2_table;
  const bool hardens = spec.effect("hardening") && (table ? m.flow_stress.size() > 1 : m.B != 0.0);
  e.hardening = !hardens ? Hardening::none : table ? Hardening::table : Hardening::power;
  const bool rate = spec.effect("strain_rate") && m.C != 0.0;
  e.rate = !rate ? RateLaw::none : (m.law == MaterialLaw::johnson_cook_log ? RateLaw::logarithmic : RateLaw::power);
  e.heating = spec.effect("heating") && m.taylor_quinney != 0.0 && m.specific_heat > 0.0;
  e.expansion = spec.effect("expansion") && e.heating && m.thermal_expansion != 0.0;
  return e;
}

PlateMeshOptions mesh_options(const CaseSpec& spec) {
  return {spec.plate.size,  spec.plate.elements,         spec.run.quarter_symmetry,
          spec.plate.edges, spec.plate.material.density, spec.plate.opening};
}

PlateSolid::PlateSolid(PlateMesh mesh, const CaseSpec& spec, int threads)
    : mesh_(std::move(mesh)),
      threads_(useful_threads(mesh_, threads)),
      forces_(mesh_, metal_parameters(spec.plate.material), metal_effects(spec), threads_) {
  const std::size_t n = mesh_.node_count();
  state_.u.resize(n), state_.v.resize(n), state_.internal.resize(n), state_.external.resize(n);
  state_.mass = mesh_.mass;
  state_.hinges = mesh_.hinges;
  for (std::size_t i = 0; i < n; ++i) {
    const double inverse = 1.0 / mesh_.mass[i];
    const unsigned fixed = mesh_.fixed[i];
    state_.inverse_mass.push_back(
        {fixed & fixed_x ? 0.0 : inverse, fixed & fixed_y ? 0.0 : inverse, fixed & fixed_z ? 0.0 : inverse});
  }
  rest_step_ = rest_step();
  stable_step_ = step_safety * rest_step_;
}

/// 2 / omega_max of one free element at rest: a bound for the assembled plate (Irons' theorem), within 2 % of it. The
/// elements of a layer are all alike.
double PlateSolid::rest_step() {
  const long layer = static_cast<long>(mesh_.elements[0]) * mesh_.elements[1];
  double least = rest_step_of(0);
  if (mesh_.bent())
    for (long e = layer; e < mesh_.element_count(); e += layer) least = std::min(least, rest_step_of(e));
  return least;
}

double PlateSolid::rest_step_of(long first) {
  const Eigen::Index dofs = 3 * mesh_.element_nodes();
  auto k = std::make_unique<std::array<InternalForce::ElementMatrix, 4>>();
  forces_.element_stiffness(state_.u, first / 4, *k);
  Eigen::Map<Eigen::MatrixXd> matrix((*k)[0].data(), dofs, dofs);
  Eigen::VectorXd scale(dofs);
  for (int a = 0; a < mesh_.element_nodes(); ++a)
    scale.segment<3>(3 * a).setConstant(1.0 / std::sqrt(mesh_.element_mass(first, a)));
  const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return 2.0 / std::sqrt(solver.eigenvalues().maxCoeff());
}

Stop PlateSolid::broken(const ForceSums& sums) const {
  const Vec3 first = mesh_.gauss_position(sums.broken_element, 0),
             last = mesh_.gauss_position(sums.broken_element, mesh_.element_nodes() - 1);
  const Vec3 centre = 0.5 * (first + last);
  char text[640];
  std::snprintf(
      text, sizeof text,
      "structure: plate element %ld turned inside out (det F <= 0 or not finite)\n"
      "  at t = %.4g us, element centre at rest (%.1f, %.1f, %.2f) mm, last step %.4g us, stable step %.4g us\n"
      "  the load bends or squeezes one element beyond its shape: use more elements (plate.elements), a larger\n"
      "  stand-off, or a shorter coupling.window if the step above is larger than the stable one",
      sums.broken_element, 1e6 * time_, 1e3 * centre.x, 1e3 * centre.y, 1e3 * centre.z, 1e6 * last_dt_,
      1e6 * stable_step_);
  return Stop(ExitCode::guard, text);
}

void PlateSolid::step_back(double dt) {
  for (std::size_t i = 0; i < state_.u.size(); ++i) state_.u[i] += -dt * state_.v[i];
  time_ -= dt;
}

void PlateSolid::kick_and_drift_nodes(double dt) {
  const HalfStepSums sums = kick_and_drift(state_, dt, threads_);
  books_.external_work += sums.work, books_.received += sums.received, books_.of_supports += sums.of_supports;
  time_ += dt;
  last_dt_ = dt;
}

void PlateSolid::update_elements(double dt) {
  const ForceSums sums = forces_.evaluate(state_.u, {dt, true}, true);
  if (sums.broken_element >= 0) {
    const Stop cause = broken(sums);
    step_back(dt);
    throw cause;
  }
  elastic_ = sums.elastic;
  books_.inelastic_work += sums.inelastic;
  if (++steps_ % steps_between_estimates == 0) stable_step_ = step_safety * rest_step_ * forces_.shape_factor(state_.u);
}

void PlateSolid::kick_nodes(double dt) {
  const HalfStepSums sums = kick_with(state_, dt, threads_, [&](std::size_t i) { return forces_.at_node(i); });
  books_.external_work += sums.work, books_.received += sums.received, books_.of_supports += sums.of_supports;
}

void PlateSolid::collect_internal_force() {
  for (std::size_t i = 0; i < state_.internal.size(); ++i) state_.internal[i] = forces_.at_node(i);
}

void PlateSolid::set_motion(std::span<const Vec3> u, std::span<const Vec3> v) {
  std::copy(u.begin(), u.end(), state_.u.begin());
  std::copy(v.begin(), v.end(), state_.v.begin());
  const ForceSums sums = forces_.evaluate(state_.u, {0.0, false}, false);
  if (sums.broken_element >= 0) throw broken(sums);
  elastic_ = sums.elastic;
  collect_internal_force();
  stable_step_ = step_safety * rest_step_ * forces_.shape_factor(state_.u);
}

void PlateSolid::commit(std::span<const Vec3> u, double dt) {
  std::copy(u.begin(), u.end(), state_.u.begin());
  const ForceSums sums = forces_.evaluate(state_.u, {dt, true}, true);
  if (sums.broken_element >= 0) throw broken(sums);
  elastic_ = sums.elastic;
  books_.inelastic_work += sums.inelastic;
  collect_internal_force();
}

}  // namespace standoff::structure
