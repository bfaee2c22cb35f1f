// Effect drop_outgoing: grains that can no longer reach the plate are taken out.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

/// Share of all directions from the charge that miss a square of half width a at distance R: the solid angle of a
/// square seen from above its centre is 4 arcsin(a^2/(a^2 + R^2)) [Mathar, Solid Angle of a Rectangular Plate, 2015,
/// eq. 27].
double missing_share(const CaseSpec& spec) {
  const bool cover = spec.plate.surround == "rigid";
  const double half = 0.5 * (cover ? spec.plate.surround_size : std::max(spec.plate.size.x, spec.plate.size.y));
  const double square = half * half, distance = spec.run.stand_off;
  return 1.0 - std::asin(square / (square + distance * distance)) / std::numbers::pi;
}

/// Products behind a grain can still turn it round or push others into it, and no figure known before a run excludes
/// that: so it is off unless a case states it.
EffectFinding find(const CaseSpec& spec) {
  if (!has_sand(spec)) return nothing("there is no sand");
  if (spec.domain.closed()) return nothing("the box is closed: grains come back");
  if (spec.domain.repeats()) return nothing("the scene repeats: grains come to the next plate");
  return {true, false,
          fmt::format("{:.0f} % of all directions from the charge miss plate and cover, but products may still push "
                      "grains that fly there",
                      100.0 * missing_share(spec))};
}

EffectCost cost(const CaseSpec& spec, const SceneWork& work) {
  // A saving: what misses is gone for about the second half of the run.
  return {.seconds = -0.5 * missing_share(spec) * work.sand_s};
}

}  // namespace

Effect drop_outgoing() {
  return {
      .name = "drop_outgoing",
      .doc = "Grains that can no longer reach the plate are taken out and booked as escaped.",
      .rule = "off unless stated: exact for grains that nothing overtakes, which no figure known before a run can tell",
      .without = "grains that fly past the plate are computed until they leave the domain",
      .find = find,
      .cost = cost,
      .stages = {"drop_outgoing"},
  };
}

}  // namespace standoff::effects
