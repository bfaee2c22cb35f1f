// Effect air: ambient air around charge and plate, simulated where it does not stand still.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"
#include "coupling/case/particle_bytes.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!spec.air.on) return nothing("air.mode = \"off\": nothing around charge and plate");
  return {true, true,
          fmt::format("air.mode = \"on\": {:.4g} kg/m3 at {:.4g} Pa, simulated where it does not stand still",
                      spec.air.density, spec.air.pressure)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  return {.bytes = work.air * air_bytes, .seconds = work.air_s};
}

}  // namespace

Effect air() {
  return {
      .name = "air",
      .doc = "Ambient air around charge and plate.",
      .rule = "on if air.mode = \"on\": a bare charge pushes its own mass of air, sand outweighs it",
      .without = "the products fly through a vacuum: no blast wave, nothing brakes them",
      .find = find,
      .cost = cost,
      .leave_out = [](CaseSpec& spec) { spec.air.on = false; },
      .switched_by = "air.mode",
      .stages = {"air_collide", "air_drift", "air_boundaries"},
      .columns = {"impulse_air_Ns", "air_internal_J", "air_kinetic_J"},
      .results = {"impulse_air_Ns"},
  };
}

}  // namespace standoff::effects
