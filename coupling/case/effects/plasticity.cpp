// Effect plasticity: the plate yields; without, it is elastic and holds no history.
#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("law = \"elastic\": no yield stress");
  const MaterialSpec& m = spec.plate.material;
  const double impact = estimate(spec).wall_speed * std::sqrt(m.youngs_modulus * m.density);
  return {true, true,
          fmt::format("yields at {:.0f} MPa; the wall speed alone is a bar stress of {:.2g} MPa", 1e-6 * m.A,
                      1e-6 * impact)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  return {.bytes = work.points * 10.0 * sizeof(double), .seconds = 0.35 * work.structure_s};
}

}  // namespace

Effect plasticity() {
  return {
      .name = "plasticity",
      .doc = "The plate yields; without, it is elastic and holds no history.",
      .rule = "on unless plate.material.law = \"elastic\"",
      .without = "the plate springs back to flat: no permanent deflection, no plastic history",
      .find = find,
      .cost = cost,
      .results = {"max_plastic_strain", "centre_plastic_strain", "max_plastic_strain_away_from_clamp"},
  };
}

}  // namespace standoff::effects
