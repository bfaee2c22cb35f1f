#include "structure_solver/models/single_dof/plate_spring.hpp"

#include <algorithm>
#include <cmath>

#include "structure_solver/models/plate_hex64/plate_solid.hpp"

namespace standoff::structure {

PlateSpring::PlateSpring(const CaseSpec& spec)
    : plate_(equivalent_plate(spec)), sheet_(spec), yields_(metal_effects(spec).plasticity) {
  history_.sheet = sheet_.at_rest();
}

PlateSpring::Answer PlateSpring::answer(double w, double dt, History& h) const {
  const double trial = plate_.bending_stiffness * (w - h.hinge_slip);
  const double bending = yields_ ? std::clamp(trial, -plate_.hinge_force, plate_.hinge_force) : trial;
  const double slip = (trial - bending) / plate_.bending_stiffness;
  h.hinge_slip += slip;
  const double stretch_before = h.sheet.plastic_stretch;
  const double stress = sheet_.stretch(plate_.strain(w), dt, h.sheet);
  const double flowed = 2.0 * stress * (h.sheet.plastic_stretch - stretch_before);
  return {bending + plate_.sheet_force(stress, w),
          0.5 * bending * bending / plate_.bending_stiffness + plate_.volume * stress * stress / sheet_.modulus(),
          bending * slip + plate_.volume * flowed};
}

PlateSpring::Answer PlateSpring::trial(double w, double dt) const {
  History copy = history_;
  return answer(w, dt, copy);
}

PlateSpring::Answer PlateSpring::commit(double w, double dt) {
  return answer(w, dt, history_);
}

double PlateSpring::stiffness(double w) const {
  const double stress = sheet_.modulus() * (plate_.strain(w) - history_.sheet.plastic_stretch);
  const double by_strain = plate_.sheet_force(sheet_.modulus(), w);
  const double strain_by_w = 0.5 * w / (plate_.half * plate_.half);
  return plate_.bending_stiffness + plate_.sheet_force(stress, 1.0) + by_strain * strain_by_w;
}

void SpringMotion::take(const PlateSpring::Answer& answer) {
  internal = answer.force, elastic = answer.elastic, plastic += answer.plastic;
}

void SpringMotion::step(double push, double dt) {
  const double mass = spring.plate().mass;
  velocity += 0.5 * dt * (push - internal) / mass;
  const double move = dt * velocity;
  w += move, work += push * move;
  take(spring.commit(w, dt));
  velocity += 0.5 * dt * (push - internal) / mass;
}

void SpringMotion::set_state(std::span<const double> u, std::span<const double> v) {
  w = u[0], velocity = v[0];
  const PlateSpring::Answer now = spring.trial(w, 0.0);
  internal = now.force, elastic = now.elastic;
}

bool SpringMotion::internal_force(std::span<const double> u, double dt, std::span<double> f) {
  f[0] = spring.trial(u[0], dt).force;
  return std::isfinite(f[0]);
}

void SpringMotion::commit(std::span<const double> u, double dt) {
  w = u[0];
  take(spring.commit(w, dt));
}

Eigen::SparseMatrix<double> SpringMotion::stiffness(std::span<const double> u) {
  Eigen::SparseMatrix<double> k(1, 1);
  k.insert(0, 0) = spring.stiffness(u[0]);
  return k;
}

}  // namespace standoff::structure
