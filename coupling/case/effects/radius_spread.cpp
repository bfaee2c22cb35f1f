// Effect radius_spread: grains of different size.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!has_sand(spec)) return nothing("there is no sand");
  const double spread = spec.soil.radius_spread;
  if (spread <= 0.0) return nothing("equal grains: no array of radii");
  return {true, true, fmt::format("radii spread by +-{:.3g} %: every grain has its own", 100.0 * spread)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  return {.bytes = work.grains * 2.0 * sizeof(double)};
}

}  // namespace

Effect radius_spread() {
  return {
      .name = "radius_spread",
      .doc = "Grains of different size.",
      .rule = "on if soil.radius_spread > 0",
      .without = "equal grains: no array of radii; above 60 % packing they arrange themselves in crystals",
      .find = find,
      .cost = cost,
      .leave_out = [](CaseSpec& spec) { spec.soil.radius_spread = 0.0; },
      .in_a_cell = true,
  };
}

}  // namespace standoff::effects
