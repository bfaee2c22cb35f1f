#pragma once
// Stage gas_collide: every hit of a gas particle within one sub-step, at its exact time.
//
// Mutual earliest partner: each particle finds the earliest hit on its present straight path (another gas particle, a
// grain, the sheet, a plane that mirrors); a pair is resolved only if each is the other's earliest; then only touched
// particles look again, until no hit is left in the sub-step. Each hit writes two particles owned by one pair: no
// races, no atomics, the same bits for any number of threads. Pairs that already overlap and approach fire at once.
//
// Causality. A path is valid from its body's last hit on, so a pair is tested from the later of the two last hits. A
// hit that should have happened before that, because a third body deflected one of them too late to be seen, is not
// invented afterwards: the pair overlaps then, and if it still approaches it fires at once. What is lost is the order
// of hits that depend on each other within one sub-step; it vanishes with the step and is measured as the pressure Z
// against Carnahan-Starling (tests/verification). Unreleased gas stands still and cannot be passed; it keeps what it
// is given (kernels/gas_release.hpp).
//
// Files: gas_work.hpp arrays; gas_load.cpp in and out of cell order; gas_search.cpp earliest hits; gas_resolve.cpp the
// hits; gas_step_control.cpp the next step.
#include <cstdint>
#include <memory>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/kernels/periodic_images.hpp"
#include "particle_solver/kernels/reflecting_planes.hpp"
#include "particle_solver/search/gas_cell_grid.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

/// What one call did, and what the step control needs.
struct GasCollideCounts {
  long gas_hits = 0, sand_hits = 0, sheet_hits = 0, mirror_hits = 0;
  long unreleased_hits = 0;  // on gas that waits for the detonation
  long searches = 0;         // bodies that looked for their earliest hit, over all rounds
  long candidates = 0;       // gas in the cells that these searches read
  long deferred = 0;         // hits left for the next sub-step by the limit on rounds (gas_collide.cpp); normally 0
  int rounds = 0;            // until nothing was left: the longest chain of hits that depend on each other
  int usual_rounds = 0;      // until 98 % of the hits were done: does not grow with the number of particles
  double pair_virial = 0.0;  // J, sum of impulse times centre distance over gas pairs: p V = N k T + virial / (3 time)
  Vec3 mirror_impulse;       // N s given to mirrors and walls of the box
  double plate_impulse = 0.0;   // N s given to the plate (not its rigid surround), positive away from the charge
  double plate_incoming = 0.0;  // kg m/s of particles at their first contact, positive away from the charge

  long hits() const { return gas_hits + sand_hits + sheet_hits + mirror_hits + unreleased_hits; }
};

struct GasCollideOptions {
  bool internal_energy = true;  // Larsen-Borgnakke exchange; off = elastic spheres, a gas of gamma 5/3
  std::uint64_t seed = 1;
  MirrorPlanes mirrors;    // of a quarter model
  ReflectingPlanes walls;  // of a closed box
  PeriodicSides periodic;  // of a scene that repeats, without mirrors and walls
  int threads = 1;
};

class GasCollide {
 public:
  explicit GasCollide(const GasCollideOptions& options);
  ~GasCollide();
  /// Resolves all hits in a sub-step of length h [s]; `sand` and `sheet` may be null. `step` numbers the call.
  GasCollideCounts run(GasState& gas, SandState* sand, SurfaceSheet* sheet, double h, std::uint32_t step);
  /// Next sub-step [s] from the state and from the rounds the last one needed; at most `cap`. `last_step` is what this
  /// function returned before (0 at first), also when a shorter step was then taken to end a window: growth builds on
  /// it.
  double suggest_step(const GasState& gas, const GasCollideCounts& last, double last_step, double cap) const;

  /// The grid of run(), which no one needs between two calls.
  GasCellGrid& idle_grid();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace standoff::particles
