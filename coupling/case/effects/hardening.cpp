// Effect hardening: the yield stress grows with plastic strain.
#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("the plate does not yield");
  const MaterialSpec& m = spec.plate.material;
  if (m.law == MaterialLaw::j2_table) {
    if (m.flow_stress.size() < 2) return nothing("one point in the table: perfectly plastic");
    return {true, true,
            fmt::format("the table rises from {:.0f} to {:.0f} MPa", 1e-6 * m.A, 1e-6 * m.flow_stress.back())};
  }
  if (m.B <= 0.0) return nothing("B = 0: yield stress does not depend on plastic strain");
  const double at_tenth = m.B * std::pow(0.1, m.n);
  return {true, true,
          fmt::format("10 % plastic strain adds {:.0f} MPa to A = {:.0f} MPa", 1e-6 * at_tenth, 1e-6 * m.A)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  return {.seconds = 0.1 * work.structure_s};
}

}  // namespace

Effect hardening() {
  return {
      .name = "hardening",
      .doc = "Yield stress grows with plastic strain.",
      .rule = "on if the law hardens: B > 0, or more than one point in the table",
      .without = "perfectly plastic: the plate gives way more, and strain gathers in hinges",
      .find = find,
      .cost = cost,
      .needs = "plasticity",
  };
}

}  // namespace standoff::effects
