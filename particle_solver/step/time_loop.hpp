#pragma once
// The time loop of the particle process: the stages this scene calls for, composed once, then called in order.
//
//   one sand step dt                                                          one gas sub-step h = dt / n
//   sand_integrate (half kick) -> stages of effects/ -> surface_contact -> boundaries -> n x [ detonate -> gas_collide
//   -> gas_drift ]
//                  -> wrap, if the scene repeats -> sand_pairs -> sand_integrate (half kick) -> hard_core
// Grains that turn: grain_rotation after each half kick. A window begins with surface_carry, where gas or air meets a
// plate that recedes; air moves then: air_collide -> air_drift -> air_boundaries.
//
// A scene without sand is the bracket and boundaries; a scene without gas drifts once per step. What is absent is not
// in the list: no test, no array, no timer row. Stage name = file name = timer name = row of the report.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coupling/base/stage_timer.hpp"
#include "particle_solver/effects/particle_effect.hpp"
#include "particle_solver/kernels/periodic_images.hpp"
#include "particle_solver/ledger/particle_ledger.hpp"
#include "particle_solver/scene/scene.hpp"
#include "particle_solver/step/air_boundaries.hpp"
#include "particle_solver/step/air_collide.hpp"
#include "particle_solver/step/air_drift.hpp"
#include "particle_solver/step/boundaries.hpp"
#include "particle_solver/step/drop_outgoing.hpp"
#include "particle_solver/step/gas_collide.hpp"
#include "particle_solver/step/hard_core.hpp"
#include "particle_solver/step/surface_carry.hpp"
#include "particle_solver/step/surface_contact.hpp"

namespace standoff::particles {

/// What the loop has counted since the start; simulated part, SI, positive away from the charge.
struct LoopTotals {
  long steps = 0, sub_steps = 0, particle_steps = 0;
  double impulse_gas = 0.0, impulse_sand = 0.0;  // N s on the plate
  double impulse_air = 0.0;                      // N s, net of the ambient pressure on the rear
  double incoming = 0.0;                         // kg m/s at first contact with the plate
  double contact_loss = 0.0;                     // J, grains on plate and cover
  double contact_elastic = 0.0;                  // J now, with the soil's own law at the plate
  double escaped_contact = 0.0;                  // J since the start, in such springs of grains that were taken out
  double max_penetration_over_radius = 0.0;
  long deferred_hits = 0, hard_core_hits = 0;
  CarriedGas carried;
  double step = 0.0;       // s, the last
  std::string limited_by;  // what limited it
  template <class Archive>
  void archive(Archive& a) {
    a(steps, sub_steps, particle_steps, impulse_gas, impulse_sand, impulse_air, incoming, contact_loss, contact_elastic,
      escaped_contact);
    a(max_penetration_over_radius, deferred_hits, hard_core_hits, carried.particles, carried.last, step, limited_by);
  }
};

class TimeLoop {
 public:
  TimeLoop(const CaseSpec& spec, Scene& scene, int threads);
  ~TimeLoop();

  /// Steps from `begin` to begin + window [s], equal steps that respect every stable step.
  void advance(double begin, double window);
  /// Smallest stable step of the scene as it is [s].
  double stable_step() const;

  const LoopTotals& totals() const { return totals_; }
  const BoundaryBooks& boundary_books() const { return books_; }
  const BoundaryTotals& boundary_totals() const { return boundaries_.totals(); }
  const SandBooks& sand_books() const;
  const std::vector<std::unique_ptr<ParticleEffect>>& effects() const { return effects_; }
  const StageTimers& timers() const { return timers_; }
  void forget_times() { timers_.reset(); }
  ParticleEnergy energy() const;
  /// Everything that carries or took momentum: zero change means it is conserved.
  Vec3 momentum_everywhere() const;
  /// Sum of |impulse| on everything that took some, the scale of momentum_error.
  double impulse_scale() const;
  /// Sum over particles of the momentum towards the charge after their last contact with the plate, kg m/s.
  double rebound() const;

  /// Everything that outlives a window, the scene's particles and sheet included. Read into a loop of the same case and
  /// surface, it goes on with the same bits, whatever the number of threads.
  template <class Archive>
  void archive(Archive& a) {
    a(scene_.gas, scene_.sand, scene_.sheet, boundaries_, books_, totals_, last_gas_, gas_step_, gas_step_cap_,
      timers_);
    if (air_collide_) a(*scene_.air, *air_collide_);
    if (!pairs_) return;
    for (const auto& effect : effects_) a(effect->books);
    SandPairsMemory memory;
    if constexpr (!Archive::reading) memory = pairs_->memory(scene_.sand);
    a(memory);
    if constexpr (Archive::reading) pairs_->restore(scene_.sand, memory);
  }

 private:
  using Stage = std::function<void(double time, double h)>;
  void compose();
  void compose_air();
  void add(std::vector<Stage>& list, const std::string& name, Stage body);
  int timer_row(const std::string& name);
  void step(double time, double dt, long gas_steps);
  double sand_step_limit() const;
  double air_step_limit() const;
  double image_step_limit() const;
  void fill(double begin, double span);
  long gas_steps(double dt);

  Scene& scene_;
  StageTimers timers_;
  std::vector<Stage> begin_window_, begin_step_, sub_step_, end_step_;
  std::unique_ptr<GasCollide> gas_;
  std::unique_ptr<SandPairs> pairs_;
  std::unique_ptr<SurfaceContact> contact_;
  std::unique_ptr<HardCore> hard_core_;
  std::unique_ptr<DropOutgoing> drop_outgoing_;
  std::vector<std::unique_ptr<ParticleEffect>> effects_;
  std::unique_ptr<AirCollide> air_collide_;
  std::unique_ptr<AirDrift> air_drift_;
  std::unique_ptr<AirBoundaries> air_boundaries_;
  PeriodicSides sides_;
  Boundaries boundaries_;
  BoundaryBooks books_;
  LoopTotals totals_;
  GasCollideCounts last_gas_;
  double gas_step_ = 0.0, gas_step_cap_ = 0.0;  // s
  int threads_;
};

}  // namespace standoff::particles
