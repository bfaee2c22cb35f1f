// Effect surface_recession: particles meet the plate where it has moved to.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  const Estimate e = estimate(spec);
  if (e.mass <= 0.0 || e.plate <= 0.0) return nothing("nothing loads the plate");
  const double ratio = e.arriving / (e.arriving + e.plate);
  return {true, ratio > 0.001,
          fmt::format("{:.2g} kg/m2 arrive at a plate of {:.3g} kg/m2: it recedes at {:.2g} % of their speed",
                      e.arriving, e.plate, 100.0 * ratio)};
}

}  // namespace

Effect surface_recession() {
  return {
      .name = "surface_recession",
      .doc = "Particles meet the plate where it has moved to.",
      .rule = "on if the plate takes more than 0.1 % of the speed of what arrives: ratio of the masses per area",
      .without =
          "particles meet the plate at rest, as if it were rigid: they do no work on it and the load is too large",
      .find = find,
      .columns = {"work_to_structure_J", "interface_work_error_J"},
  };
}

}  // namespace standoff::effects
