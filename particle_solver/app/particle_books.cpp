#include "particle_solver/app/particle_books.hpp"

#include <cmath>

#include "coupling/base/state_hash.hpp"
#include "particle_solver/app/particle_guard.hpp"
#include "particle_solver/scene/sand_front.hpp"

namespace standoff::particles {

ParticleBooks::ParticleBooks(const CaseSpec& spec, const Scene& scene, const TimeLoop& loop)
    : spec_(spec), scene_(scene), loop_(loop) {
  ledger_.open(loop.energy(), loop.momentum_everywhere());
  if (!scene.has_sand) return;
  const SoilSpec soil = without_cut_sides(spec.soil, spec.domain.period());
  shock_.emplace(scene.sand, scene.centre, SoilBody(soil, scene.centre));
}

void ParticleBooks::observe(double time) {
  if (shock_) shock_->observe(scene_.sand, time);
}

void ParticleBooks::guard(double time, double window) const {
  guard_surface(loop_.boundary_totals(), loop_.totals().carried, scene_.charge_particles + scene_.sand_particles,
                window, time);
}

NamedValues ParticleBooks::sample(double time) {
  const ParticleEnergy energy = loop_.energy();
  guard_particle_energy(spec_, energy, ledger_.observe(energy), time);
  const LoopTotals& totals = loop_.totals();
  const double full = spec_.copies();
  NamedValues row{{"time_s", time}, {"impulse_Ns", -full * scene_.sheet.total_impulse().z}};
  if (scene_.has_gas) {
    row.insert(row.end(), {{"impulse_gas_Ns", full * totals.impulse_gas},
                           {"gas_internal_J", full * energy.gas_internal},
                           {"gas_kinetic_J", full * energy.gas_kinetic}});
  }
  if (scene_.has_air) {
    row.insert(row.end(), {{"impulse_air_Ns", full * totals.impulse_air},
                           {"air_internal_J", full * energy.air_internal},
                           {"air_kinetic_J", full * energy.air_kinetic}});
  }
  if (scene_.has_sand) {
    row.insert(row.end(), {{"impulse_sand_Ns", full * totals.impulse_sand},
                           {"sand_kinetic_J", full * energy.sand_kinetic},
                           {"sand_elastic_J", full * energy.sand_elastic},
                           {"contact_loss_J", full * energy.contact_loss},
                           {"sand_front_radius_m", sand_front_radius(scene_.sand, scene_.centre)}});
    if (spec_.effect("friction")) row.emplace_back("friction_loss_J", full * energy.friction_loss);
    if (spec_.effect("damping")) row.emplace_back("damping_loss_J", full * energy.damping_loss);
    if (spec_.effect("grain_rotation")) row.emplace_back("sand_rotation_J", full * energy.sand_rotation);
    for (const auto& effect : loop_.effects())
      row.emplace_back(std::string(effect->name()) + "_loss_J", full * effect->books.loss);
  }
  if (scene_.has_gas) row.emplace_back("escaped_gas_J", full * energy.escaped_gas);
  if (scene_.has_sand) row.emplace_back("escaped_sand_J", full * energy.escaped_sand);
  if (scene_.has_air) row.emplace_back("escaped_air_J", full * energy.escaped_air);
  row.insert(row.end(), {{"boundary_work_J", full * energy.inflow}, {"escaped_J", full * energy.escaped()}});
  if (spec_.effect("surface_recession")) row.emplace_back("work_to_structure_J", full * energy.work_to_structure);
  return row;
}

NamedValues ParticleBooks::progress(double time, long window, long windows) const {
  const LoopTotals& totals = loop_.totals();
  return {{"time_s", time},
          {"window", static_cast<double>(window)},
          {"windows", static_cast<double>(windows)},
          {"step_s", totals.step},
          {"impulse_Ns", -spec_.copies() * scene_.sheet.total_impulse().z},
          {"energy_error", ledger_.energy_error()},
          {"limited_by:" + totals.limited_by, 1.0}};
}

nlohmann::json ParticleBooks::report(const Participant::Times& times) const {
  const LoopTotals& totals = loop_.totals();
  const double full = spec_.copies();
  nlohmann::json j;
  auto& results = j["results"];
  results["impulse_Ns"] = -full * scene_.sheet.total_impulse().z;
  if (scene_.has_gas) results["impulse_gas_Ns"] = full * totals.impulse_gas;
  if (scene_.has_air) results["impulse_air_Ns"] = full * totals.impulse_air;
  if (scene_.has_sand) results["impulse_sand_Ns"] = full * totals.impulse_sand;
  results["incoming_momentum_Ns"] = full * totals.incoming;
  results["rebound_momentum_Ns"] = full * loop_.rebound();
  if (scene_.has_sand) {
    results["max_overlap_over_radius"] = loop_.sand_books().max_overlap_over_radius;
    if (std::isfinite(shock_->time())) results["shock_arrival_at_sand_surface_s"] = shock_->time();
  }
  const Vec3 residual = loop_.momentum_everywhere() - ledger_.initial_momentum();
  j["conservation"] = {{"energy_error_particles", ledger_.energy_error()},
                       {"momentum_residual_Ns", {residual.x, residual.y, residual.z}},
                       {"impulse_scale_Ns", loop_.impulse_scale()}};
  auto& counts = j["counts"];
  if (scene_.has_gas) {
    counts["charge_particles"] = scene_.charge_particles * spec_.copies();
    counts["simulated_charge_particles"] = scene_.charge_particles;
  }
  if (scene_.has_sand) {
    counts["sand_particles"] = scene_.sand_particles * spec_.copies();
    counts["simulated_sand_particles"] = scene_.sand_particles;
  }
  if (scene_.has_air) {
    const Air& air = *scene_.air;
    counts["air_particles"] = spec_.air.particles;
    counts["simulated_air_particles"] = air.next_id;
    counts["simulated_air_particles_at_end"] = air.particles.size();
    j["air"] = {{"mean_free_path_m", air.mean_free_path},
                {"knudsen_number", air.mean_free_path / spec_.run.stand_off},
                {"compressibility_factor", 1.0},
                {"cell_m", air.cells.width().z},
                {"awake_volume_m3", full * static_cast<double>(air.cells.awake_count()) * air.cells.volume()}};
  }
  counts["particle_steps"] = totals.particle_steps;
  if (scene_.sheet.recedes()) counts["carried_by_the_surface"] = totals.carried.particles;
  counts["slipped_below_the_surface"] = loop_.boundary_totals().slipped;
  counts["deferred_hits"] = totals.deferred_hits;
  if (spec_.effect("hard_core")) counts["hard_core_hits"] = totals.hard_core_hits;
  auto& timing = j["timing"]["particle"];
  timing = {{"compute_s", times.compute}, {"wait_s", times.wait}, {"exchange_s", times.exchange}};
  for (const auto& row : loop_.timers().rows()) timing["stages"][row.name] = row.seconds;
  StateHash hash;
  hash.add(std::span<const Vec3>(scene_.gas.position));
  hash.add(std::span<const Vec3>(scene_.gas.velocity));
  hash.add(std::span<const double>(scene_.gas.internal_energy));
  if (scene_.has_air) {
    hash.add(std::span<const Vec3>(scene_.air->particles.position));
    hash.add(std::span<const Vec3>(scene_.air->particles.velocity));
  }
  hash.add(std::span<const Vec3>(scene_.sand.position));
  hash.add(std::span<const Vec3>(scene_.sand.velocity));
  hash.add(std::span<const Vec3>(scene_.sand.spin));
  j["provenance"]["state_hash"] = hash.hex();
  return j;
}

}  // namespace standoff::particles
