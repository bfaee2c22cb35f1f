// Effect detonation_timing: gas particles are released when the detonation front reaches them.
#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  const ChargeSpec& c = spec.charge;
  if (!c.present) return nothing("there is no charge");
  const double way = norm(c.detonator - Vec3{0.0, 0.0, spec.run.stand_off}) + c.radius;
  const double passage = way / c.explosive.detonation_speed;
  const double thermal = std::sqrt(3.0 * (c.explosive.gamma - 1.0) * c.explosive.energy / c.explosive.density);
  const double spreading = c.radius / thermal;
  return {
      true, passage > 0.01 * spreading,
      fmt::format(
          "the front needs {:.2g} us through the charge, {:.2g} of the {:.2g} us in which the gas crosses its radius",
          1e6 * passage, passage / spreading, 1e6 * spreading)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  // time of release, flag, impulse in store, until the front has passed
  return {.bytes = work.gas * (sizeof(double) + 1.0)};
}

}  // namespace

Effect detonation_timing() {
  return {
      .name = "detonation_timing",
      .doc = "Gas particles are released when the detonation front reaches them.",
      .rule = "on if the front needs more than 1 % of the time in which the gas crosses the radius of the charge",
      .without = "the whole charge goes off at time 0: no direction of detonation, and less momentum towards the plate",
      .find = find,
      .cost = cost,
      .stages = {"detonate"},
  };
}

}  // namespace standoff::effects
