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

EffectCost cost(const CaseSpec& spec, const SceneWork& work) {
  // Of the time of the particles, on an AMD EPYC core: they follow the plate and touch it longer, and a sheet that has
  // moved is searched with slack. 6.2 against 6.5 s of
  //   standoff run cases/borvik_2011/dry_150mm --level coarse --threads 1 --set run.until="0.5 ms"
  // and 40.5 against 43.9 s of everything until 2 ms, of
  //   standoff cost cases/borvik_2011/dry_150mm --effects --levels coarse --seeds 1
  constexpr double share = 0.05;
  return {.seconds = share * (work.gas_s + (spec.air.on ? work.air_s : 0.0) + work.sand_s)};
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
      .cost = cost,
      .columns = {"work_to_structure_J", "interface_work_error_J"},
  };
}

}  // namespace standoff::effects
