// Effect large_deformation: the plate is computed where it is, not where it was.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

/// A membrane that yields with stress A and starts with speed v swings to w = v/omega, omega = 2.405/a (A/rho)^(1/2)
/// [Rayleigh, Theory of Sound, sec. 206: circular membrane of radius a]. Linear plate theory ends at w of half a
/// thickness [Timoshenko, Theory of Plates and Shells, 1959, ch. 13].
EffectFinding find(const CaseSpec& spec) {
  const MaterialSpec& m = spec.plate.material;
  if (!yields(spec) || m.A <= 0.0) return {true, true, "there is no element of small strain"};
  const double half = 0.5 * std::min(spec.plate.size.x, spec.plate.size.y);
  const double swing = estimate(spec).wall_speed * half / 2.405 * std::sqrt(m.density / m.A);
  return {true, true,
          fmt::format("the plate swings by about {:.2g} thicknesses; linear theory ends at 0.5",
                      swing / spec.plate.size.z)};
}

}  // namespace

Effect large_deformation() {
  return {
      .name = "large_deformation",
      .doc = "Finite rotations and strains of the plate.",
      .rule = "always on: the plate's elements are written for finite strain",
      .without = "there is no element of small strain to take its place",
      .find = find,
      .inherent = true,
  };
}

}  // namespace standoff::effects
