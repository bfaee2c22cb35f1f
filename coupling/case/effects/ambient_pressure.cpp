// Effect ambient_pressure: the pressure of still air on the rear of the plate.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!spec.air.on) return nothing("there is no air");
  return {
      true, true,
      fmt::format("{:.4g} Pa on the rear of the plate: {:.3g} N s over the run, as much as still air gives its front",
                  spec.air.pressure, spec.air.pressure * spec.plate.size.x * spec.plate.size.y * spec.run.until)};
}

}  // namespace

Effect ambient_pressure() {
  return {
      .name = "ambient_pressure",
      .doc = "Ambient pressure on the rear of the plate.",
      .rule = "on with air: still air gives the front of the plate the same, so a plate in it stays at rest",
      .without = "a vacuum behind the plate: the ambient pressure on its front is part of the impulse",
      .find = find,
      .needs = "air",
  };
}

}  // namespace standoff::effects
