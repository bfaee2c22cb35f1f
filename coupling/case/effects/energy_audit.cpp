// Effect energy_audit: both processes keep books of energy and momentum, and a guard stops a run whose books open.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  return {true, true,
          fmt::format("the books are read every {:.3g} us; a plate whose books open by 5 % stops the run",
                      1e6 * spec.observe.interval)};
}

}  // namespace

Effect energy_audit() {
  return {
      .name = "energy_audit",
      .doc = "Books of energy and momentum, and the guard that reads them.",
      .rule = "always on: plastic flow hides an unstable step, only the books show it",
      .without = "an unstable run could not be told from a sound one",
      .find = find,
      .inherent = true,
  };
}

}  // namespace standoff::effects
