#include "structure_solver/app/structure_books.hpp"

#include <algorithm>
#include <cmath>

#include "structure_solver/app/energy_guard.hpp"

namespace standoff::structure {

namespace {

/// Nodes of the full surface: those of a quarter once for every mirror image, those on a mirror plane once.
long full_surface_nodes(const SurfaceMesh& mesh, bool quarter) {
  long count = 0;
  for (const Vec3& x : mesh.position) count += quarter ? (x.x > 0.0 ? 2 : 1) * (x.y > 0.0 ? 2 : 1) : 1;
  return count;
}

}  // namespace

void StructureBooks::observe(const StructuralModel& model) {
  const StructureLedger books = model.ledger();
  peak_kinetic_ = std::max(peak_kinetic_, books.kinetic);
  peak_work_ = std::max(peak_work_, books.external_work);
  peak_deflection_ = std::max(peak_deflection_, model.centre_deflection());
  largest_gap_ = std::max(largest_gap_, std::abs(books.balance()));
  guard_energy(spec_, model, books, peak_work_);
}

double StructureBooks::energy_error() const {
  return peak_work_ > 0.0 ? largest_gap_ / peak_work_ : 0.0;
}

NamedValues StructureBooks::sample(const StructuralModel& model) const {
  const StructureLedger books = model.ledger();
  const double full = spec_.copies();
  return {{"centre_deflection_m", model.centre_deflection()}, {"plate_kinetic_J", full * books.kinetic},
          {"plate_elastic_J", full * books.elastic},          {"plate_plastic_J", full * books.plastic},
          {"plate_damping_J", full * books.damping},          {"external_work_J", full * books.external_work}};
}

void StructureBooks::close_momentum(const StructuralModel& model) {
  const StructureLedger books = model.ledger();
  momentum_residual_ = books.momentum - books.impulse_received - books.impulse_of_supports;
  impulse_scale_ = norm(books.momentum) + norm(books.impulse_received) + norm(books.impulse_of_supports);
}

nlohmann::json StructureBooks::report(const StructuralModel& model, const RelaxationResult* relaxation, long steps,
                                      const Participant::Times& times) const {
  const StructureExtremes extremes = model.extremes();
  nlohmann::json j;
  auto& results = j["results"] = nlohmann::json::object();
  if (relaxation != nullptr) {
    results["permanent_centre_deflection_m"] = model.centre_deflection();
    results["permanent_max_deflection_m"] = model.max_deflection();
    j["relaxation"] = {{"at_rest", relaxation->at_rest},
                       {"kinetic_ratio", relaxation->kinetic_ratio},
                       {"residual_N", relaxation->residual},
                       {"drift_m_per_period", relaxation->drift_per_period},
                       {"polish_difference_m", relaxation->polish_difference},
                       {"first_frequency_Hz", relaxation->first_frequency},
                       {"simulated_s", relaxation->simulated_time},
                       {"force_calls", relaxation->force_calls},
                       {"wall_s", relaxation->wall_relax + relaxation->wall_polish},
                       {"message", relaxation->message}};
  }
  // A model without elements cannot deform: a zero would read as a result.
  if (model.elements() > 0) {
    results["peak_centre_deflection_m"] = peak_deflection_;
    if (spec_.effect("plasticity")) {
      results["max_plastic_strain"] = extremes.max_plastic_strain;
      results["centre_plastic_strain"] = extremes.centre_plastic_strain;
      results["max_plastic_strain_away_from_clamp"] = extremes.max_plastic_strain_away_from_clamp;
    }
    if (spec_.effect("strain_rate")) results["max_strain_rate_per_s"] = extremes.max_strain_rate;
    if (spec_.effect("heating")) results["max_temperature_rise_K"] = extremes.max_temperature_rise;
  }
  j["conservation"] = {{"energy_error_structure", energy_error()},
                       {"momentum_residual_Ns", {momentum_residual_.x, momentum_residual_.y, momentum_residual_.z}},
                       {"impulse_scale_Ns", impulse_scale_}};
  const auto& mesh = spec_.plate.elements;
  j["counts"] = {{"elements", static_cast<long>(mesh[0]) * mesh[1] * mesh[2]},
                 {"simulated_elements", model.elements()},
                 {"surface_nodes", full_surface_nodes(model.surface(), spec_.run.quarter_symmetry)},
                 {"simulated_surface_nodes", model.surface().position.size()},
                 {"structure_steps", steps}};
  auto& timing = j["timing"]["structure"];
  timing = {{"compute_s", times.compute}, {"wait_s", times.wait}, {"exchange_s", times.exchange}};
  for (const auto& row : model.timers().rows()) timing["stages"][row.name] = row.seconds;
  if (relaxation != nullptr) {
    timing["stages"]["relax"] = relaxation->wall_relax;
    timing["stages"]["polish"] = relaxation->wall_polish;
  }
  StateHash hash;
  model.add_to(hash);
  j["provenance"]["state_hash"] = hash.hex();
  return j;
}

}  // namespace standoff::structure
