// Effect relaxation: the plate is brought to rest after the particle phase.
#include "coupling/case/effects/effect.hpp"
#include "coupling/case/structural_models.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (spec.plate.model == material_point_model)
    return nothing("one material point: there is no plate to bring to rest");
  return {true, spec.run.settle,
          spec.run.settle ? "run.settle: the plate is brought to rest for its permanent shape"
                          : "run.settle = false: the run ends while the plate moves"};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  constexpr double factor_bytes = 12e3;  // of the sparse factor, a Gauss point
  return {.bytes = work.points * factor_bytes, .seconds = work.relaxation_s, .memory = MemoryOf::structure};
}

}  // namespace

Effect relaxation() {
  return {
      .name = "relaxation",
      .doc = "The plate is brought to rest after the particle phase.",
      .rule = "on if run.settle = true",
      .without = "the run ends while the plate moves: no permanent deflection, no certificate",
      .find = find,
      .cost = cost,
      .leave_out = [](CaseSpec& spec) { spec.run.settle = false; },
      .stages = {"relax", "polish"},
  };
}

}  // namespace standoff::effects
