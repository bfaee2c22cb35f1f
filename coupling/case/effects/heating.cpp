// Effect heating: plastic work heats the plate and softens it.
#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("the plate does not yield");
  const MaterialSpec& m = spec.plate.material;
  if (m.taylor_quinney <= 0.0) return nothing("chi = 0: plastic work does not heat");
  const double rise = estimate(spec).heating;
  const double softening = std::pow(rise / (m.melting_temperature - m.room_temperature), m.m);
  return {true, softening > 0.001,
          fmt::format("plastic work heats by about {:.2g} K, which takes {:.2g} % off the yield stress", rise,
                      100.0 * softening)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  return {.bytes = work.points * sizeof(double), .seconds = 0.02 * work.structure_s};
}

}  // namespace

Effect heating() {
  return {
      .name = "heating",
      .doc = "Plastic work heats the plate and softens it.",
      .rule = "on if the heat of the whole kinetic energy of the plate takes more than 0.1 % off its yield stress",
      .without = "the plate stays cold and a little too hard; no temperature is stored",
      .find = find,
      .cost = cost,
      .needs = "plasticity",
      .results = {"max_temperature_rise_K"},
  };
}

}  // namespace standoff::effects
