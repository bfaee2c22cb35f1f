#include "structure_solver/models/rigid_plate/rigid_plate.hpp"

#include <cmath>
#include <limits>

#include "structure_solver/models/plate_hex64/plate_solid.hpp"

namespace standoff::structure {
namespace {

double plate_mass(const CaseSpec& spec) {
  const Vec3& size = spec.plate.size;
  return spec.plate.material.density * size.x * size.y * size.z / spec.copies();
}

}  // namespace

RigidPlate::RigidPlate(const CaseSpec& spec)
    : free_(spec.plate.edges == "free" || spec.plate.edges == "symmetry"),
      mass_(plate_mass(spec)),
      stable_step_(spec.plate.size.z / std::sqrt(spec.plate.material.youngs_modulus / spec.plate.material.density)),
      shaped_(
          mesh_options(spec), [](const Vec3&) { return 1.0; },
          free_ ? mass_ : std::numeric_limits<double>::infinity()) {}

void RigidPlate::set_surface_force(std::span<const Vec3> force) {
  push_ = shaped_.force_along(force);
  force_ = {};
  for (const Vec3& f : force) force_ += f;
}

void RigidPlate::step(double dt) {
  time_ += dt;
  impulse_ += dt * force_;
  if (!free_) return;
  const double gained = dt * push_ / mass_;
  const double move = dt * (velocity_ + 0.5 * gained);  // exact under the held force
  way_ += move, velocity_ += gained, work_ += push_ * move;
}

StructureLedger RigidPlate::ledger() const {
  StructureLedger ledger;
  ledger.kinetic = 0.5 * mass_ * velocity_ * velocity_;
  ledger.external_work = work_;
  ledger.momentum = {0.0, 0.0, -mass_ * velocity_};
  ledger.impulse_received = impulse_;
  ledger.impulse_of_supports = {-impulse_.x, -impulse_.y, free_ ? 0.0 : -impulse_.z};
  return ledger;
}

void RigidPlate::add_to(StateHash& hash) const {
  hash.add(impulse_);
  if (free_) hash.add(way_), hash.add(velocity_);
}

}  // namespace standoff::structure
