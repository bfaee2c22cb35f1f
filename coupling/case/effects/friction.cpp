// Effect friction: Coulomb friction between grains [Geotechnique 29 (1979) 47].
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"
#include "coupling/case/particle_bytes.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!has_sand(spec)) return nothing("there is no sand");
  const double mu = spec.soil.friction;
  if (mu <= 0.0) return nothing("mu = 0: no tangential history is stored");
  return {true, true, fmt::format("mu = {:.3g} > 0: tangential history is stored", mu)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  constexpr double history_s = 80e-9;  // s a grain and step, measured on an AMD EPYC core
  return {.bytes = work.grains * history_bytes, .seconds = work.sand_steps * work.grains * history_s};
}

}  // namespace

Effect friction() {
  return {
      .name = "friction",
      .doc = "Coulomb friction between grains.",
      .rule = "on if soil.friction > 0",
      .without =
          "grains slide freely: no tangential history, and the lateral pressure of the soil rises to the axial one",
      .find = find,
      .cost = cost,
      .leave_out = [](CaseSpec& spec) { spec.soil.friction = 0.0; },
      .in_a_cell = true,
      .columns = {"friction_loss_J"},
  };
}

}  // namespace standoff::effects
