// Effect damping: a dashpot along the normal of every contact of grains.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!has_sand(spec)) return nothing("there is no sand");
  const double xi = spec.soil.damping;
  if (xi <= 0.0) return nothing("xi = 0: contacts are elastic");
  return {true, true, fmt::format("xi = {:.3g} of critical: contacts dissipate", xi)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  constexpr double dashpot_s = 5e-9;  // s a grain and step, measured on an AMD EPYC core
  return {.seconds = work.sand_steps * work.grains * dashpot_s};
}

}  // namespace

Effect damping() {
  return {
      .name = "damping",
      .doc = "Normal dashpot between grains.",
      .rule = "on if soil.damping > 0",
      .without = "contacts of grains are elastic",
      .find = find,
      .cost = cost,
      .leave_out = [](CaseSpec& spec) { spec.soil.damping = 0.0; },
      .in_a_cell = true,
      .columns = {"damping_loss_J"},
  };
}

}  // namespace standoff::effects
