#include "structure_solver/models/single_dof/single_dof.hpp"

#include <algorithm>
#include <cmath>

#include "structure_solver/models/plate_hex64/plate_solid.hpp"

namespace standoff::structure {
namespace {

constexpr double strain_rate_interval = 10e-6;  // s, the contract's definition of max_strain_rate

}  // namespace

SingleDof::SingleDof(const CaseSpec& spec)
    : room_temperature_(spec.plate.material.room_temperature),
      // One transit of a wave through the thickness: what is faster is no motion of a plate. Far below the stable step.
      longest_step_(spec.plate.size.z / std::sqrt(spec.plate.material.youngs_modulus / spec.plate.material.density)),
      motion_(spec),
      shaped_(
          mesh_options(spec), [plate = motion_.spring.plate()](const Vec3& x) { return plate.phi(x); },
          motion_.spring.plate().mass) {}

void SingleDof::set_surface_force(std::span<const Vec3> force) {
  push_ = shaped_.force_along(force);
  force_ = {};
  for (const Vec3& f : force) force_ += f;
}

double SingleDof::stable_step() const {
  const double tangent = std::max(motion_.spring.stiffness(motion_.w), plate().bending_stiffness);
  return std::min(longest_step_, step_safety * 2.0 * std::sqrt(plate().mass / tangent));
}

void SingleDof::step(double dt) {
  motion_.step(push_, dt);
  received_ += dt * force_;
  time_ += dt;
  if (time_ >= mark_time_ + strain_rate_interval - 0.5 * dt) watch_strain_rate();
}

void SingleDof::watch_strain_rate() {
  const double strain = motion_.spring.sheet().strain;
  max_strain_rate_ = std::max(max_strain_rate_, (strain - strain_mark_) / (time_ - mark_time_));
  strain_mark_ = strain, mark_time_ = time_;
}

StructureLedger SingleDof::ledger() const {
  StructureLedger ledger;
  ledger.kinetic = 0.5 * plate().mass * motion_.velocity * motion_.velocity;
  ledger.elastic = motion_.elastic, ledger.plastic = motion_.plastic, ledger.damping = motion_.damping;
  ledger.external_work = motion_.work;
  ledger.momentum = {0.0, 0.0, -plate().momentum * motion_.velocity};
  ledger.impulse_received = received_;
  ledger.impulse_of_supports = ledger.momentum - received_;  // of whatever keeps the plate in its shape
  return ledger;
}

StructureExtremes SingleDof::extremes() const {
  const SheetState& sheet = motion_.spring.sheet();
  return {sheet.strain, sheet.strain, sheet.strain, max_strain_rate_, sheet.temperature - room_temperature_};
}

void SingleDof::add_to(StateHash& hash) const {
  hash.add(motion_.w), hash.add(motion_.velocity), hash.add(motion_.spring.sheet().strain);
}

void SingleDof::refuse_other(std::size_t nodes) const {
  if (nodes != surface().position.size())
    throw Stop(ExitCode::checkpoint_incompatible,
               "structure: the saved plate has " + std::to_string(nodes) + " surface nodes, this one " +
                   std::to_string(surface().position.size()) + "\n  a state fits the case that wrote it");
}

}  // namespace standoff::structure
