// Effect strain_rate: the yield stress grows with strain rate.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("the plate does not yield");
  const MaterialSpec& m = spec.plate.material;
  if (m.C <= 0.0) return nothing("C = 0: yield stress does not depend on strain rate");
  const double relative = estimate(spec).rate / m.reference_rate;
  const double factor = m.law == MaterialLaw::johnson_cook_log ? 1.0 + m.C * std::log(std::max(relative, 1.0))
                                                               : std::pow(1.0 + relative, m.C);
  return {true, factor > 1.01,
          fmt::format("about {:.2g} 1/s raises the yield stress by {:.2g} %", relative * m.reference_rate,
                      100.0 * (factor - 1.0))};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  return {.seconds = 0.08 * work.structure_s};
}

}  // namespace

Effect strain_rate() {
  return {
      .name = "strain_rate",
      .doc = "Yield stress grows with strain rate.",
      .rule =
          "on if the rate that the load suggests, wall speed over half width, raises the yield stress by more than 1 %",
      .without = "the plate is too soft by what the rate adds to its yield stress: it bulges further",
      .find = find,
      .cost = cost,
      .needs = "plasticity",
      .results = {"max_strain_rate_per_s"},
  };
}

}  // namespace standoff::effects
