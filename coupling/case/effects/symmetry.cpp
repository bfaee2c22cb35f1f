// Effect symmetry: one quarter between two mirror planes.
#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  const bool quarter = spec.run.quarter_symmetry;
  return {true, quarter,
          quarter ? "run.symmetry = \"quarter\": mirror planes x = 0 and y = 0, a quarter of the work"
                  : "run.symmetry = \"none\": everything is computed"};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  // A saving: the other three quarters, as dear as this one, or three quarters of all.
  return {.seconds = (work.copies > 1.0 ? -3.0 : -0.75) * work.all_s};
}

}  // namespace

Effect symmetry() {
  return {
      .name = "symmetry",
      .doc = "One quarter between two mirror planes.",
      .rule = "on if run.symmetry = \"quarter\"",
      .without = "the full scene is computed: four times the work, and four independent quarters of particles",
      .find = find,
      .cost = cost,
  };
}

}  // namespace standoff::effects
