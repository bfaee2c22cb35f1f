#pragma once
// What a case will cost before it runs: particles, steps, windows, memory, seconds, effect by effect. Pure arithmetic
// on a CaseSpec and the constants of cost_constants.hpp.
//
//   spheres of gas      r = (3 b V0 / 4 pi N)^(1/3), v = sqrt(2 xi e), xi = 3 (gamma - 1) / 2  [Borvik 2011, sec. 3.2]
//   gas sub-steps       integral dt / min(window, max(c1 d, c2 lambda) / v), lambda = V / (sqrt(2) pi d^2 N), V the
//                       bubble that grows with the speed of its boundary: the gas itself, or a shell driven at the
//                       Gurney speed sqrt(2 E / (M/C + 3/5)) (Gurney 1943, sphere)
//   sand step           f 2 sqrt(m/k), k = (L/L0) k0, L the side of a cell of 1000 grains      [Borvik 2011, sec. 3.3]
//   structure step      courant h / c, c the longitudinal wave speed, h the shortest edge of an element; step,
//                       price and points of other models in proportion (coupling/case/structural_models.hpp)
//   window "auto"       a shear wave crosses at most one quad of the surface, and the plate moves at most a tenth of
//                       the smallest particle radius
#include <optional>
#include <string>
#include <vector>

#include "coupling/case/effects/effect.hpp"
#include "coupling/launcher/cost_constants.hpp"

namespace standoff::launch {

struct EffectPrice {
  std::string name;
  bool on = false;
  std::string reason;
  double bytes = 0.0, seconds = 0.0;  // of one core
  MemoryOf memory = MemoryOf::counted;
  bool more_seconds = false;             // sand_s grows by these
  std::optional<EffectCost> overriding;  // what turning it round adds; nothing: it cannot be turned round
  std::string without;                   // what a result misses without it
  std::string switched_by;               // the key that does it, if not [effects]
};

struct CostPrediction {
  long charge_particles = 0, sand_particles = 0, air_particles = 0, elements = 0;  // full domain
  double copies = 1.0;                                                             // simulated = full / copies
  double gas_step = 0.0, sand_step = 0.0, structure_step = 0.0;                    // s, at the start; 0 = absent
  double gas_steps = 0.0, sand_steps = 0.0, structure_steps = 0.0;
  double window = 0.0, windows = 0.0;
  double air_steps = 0.0, awake_air = 0.0;  // steps, and full-domain particles awake at the end
  double air_s = 0.0, gas_s = 0.0, sand_s = 0.0, packing_s = 0.0, structure_s = 0.0, relaxation_s = 0.0,
         exchange_s = 0.0;  // one core each
  double wall_s = 0.0;
  double particle_bytes = 0.0, structure_bytes = 0.0;
  int particle_threads = 1, structure_threads = 1;
  std::vector<EffectPrice> effects;

  double simulated(long full) const { return static_cast<double>(full) / copies; }
  double core_s() const { return air_s + gas_s + sand_s + packing_s + structure_s + relaxation_s + exchange_s; }
};

/// threads = 0: chosen from `cores` (the side that computes longer gets more; both compute at once in the parallel
/// scheme).
CostPrediction predict_cost(const CaseSpec& spec, int cores, int particle_threads = 0, int structure_threads = 0,
                            const CostConstants& constants = {});

}  // namespace standoff::launch
