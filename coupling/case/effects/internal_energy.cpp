// Effect internal_energy: the share of the energy that is not motion, exchanged in collisions.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!spec.charge.present) return nothing("there is no gas");
  const double gamma = spec.charge.explosive.gamma, share = 1.5 * (gamma - 1.0);
  if (share > 1.0 - 1e-9) return nothing("gamma = 5/3: all energy is motion");
  return {true, true,
          fmt::format("gamma = {:.4g}: {:.0f} % of the energy is motion, the rest rotation and vibration", gamma,
                      100.0 * share)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  return {.bytes = work.gas * sizeof(double), .seconds = 0.1 * work.gas_s};
}

}  // namespace

Effect internal_energy() {
  return {
      .name = "internal_energy",
      .doc = "Gas particles exchange energy of rotation and vibration in collisions.",
      .rule = "on unless gamma = 5/3: the share of the energy that is motion is 3 (gamma - 1) / 2",
      .without = "the products are a gas of gamma 5/3: they cool faster and push longer for the same energy of motion",
      .find = find,
      .cost = cost,
  };
}

}  // namespace standoff::effects
