// Effect expansion: a heated plate expands.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("the plate does not yield, so it stays cold");
  const MaterialSpec& m = spec.plate.material;
  if (m.thermal_expansion <= 0.0) return nothing("alpha = 0: heat does not strain");
  const double strain = m.thermal_expansion * estimate(spec).heating, yield = m.A / m.youngs_modulus;
  return {true, strain > 0.05 * yield,
          fmt::format("thermal strain of about {:.1e} against {:.1e} at yield", strain, yield)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  return {.seconds = 0.01 * work.structure_s};
}

}  // namespace

Effect expansion() {
  return {
      .name = "expansion",
      .doc = "A heated plate expands.",
      .rule = "on if the thermal strain exceeds a twentieth of the strain at yield",
      .without = "heat does not strain the plate",
      .find = find,
      .cost = cost,
      .needs = "heating",
  };
}

}  // namespace standoff::effects
