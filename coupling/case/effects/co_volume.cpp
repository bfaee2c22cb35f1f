// Effect co_volume: the volume of the gas particles, which raises the pressure of dense products.
#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

EffectFinding find(const CaseSpec& spec) {
  if (!spec.charge.present) return nothing("there is no gas");
  const double b = spec.charge.explosive.fill;
  if (b <= 0.0) return nothing("fill = 0: points without volume");
  // Carnahan and Starling, J. Chem. Phys. 51 (1969) 635, eq. 10.
  const double z = (1.0 + b + b * b - b * b * b) / std::pow(1.0 - b, 3);
  return {true, true, fmt::format("fill = {:.3g}: sphere volume raises the first pressure {:.2g}-fold", b, z)};
}

}  // namespace

Effect co_volume() {
  return {
      .name = "co_volume",
      .doc = "Gas particles are spheres with a volume of their own.",
      .rule = "on if charge.explosive.fill > 0; the pressure rises by Z of Carnahan and Starling (1969)",
      .without =
          "inherent: particles meet because they are spheres; charge.explosive.fill sets how much volume they have",
      .find = find,
      .inherent = true,
  };
}

}  // namespace standoff::effects
