// Effect grain_rotation: the friction between grains turns them.
#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

/// Between two rough spheres of moment 2/5 m r^2 slip ends, or a tangential spring is answered, with 2/7 of the mass
/// that moves when they do not turn [Brilliantov et al., Phys. Rev. E 53 (1996) 5382]. No scene asks for it: the
/// friction of the paper was chosen for grains that do not turn, so with turning it is another soil.
EffectFinding find(const CaseSpec& spec) {
  if (!has_sand(spec)) return nothing("there is no sand");
  const double mu = spec.soil.friction;
  if (mu <= 0.0) return nothing("mu = 0 between grains: no tangential force turns them");
  return {true, false,
          fmt::format("mu = {:.3g} was chosen for grains that only translate; turning, they slide with 2/7 of their "
                      "mass, so the soil is weaker",
                      mu)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  // s a grain and step on an AMD EPYC core: 4.09 against 3.90 s of processor time, 1.9e7 steps of a grain [standoff run
  // cases/borvik_2011/dry_150mm --level coarse --threads 1 --set plate.model=rigid_plate --set run.until="0.3 ms"]
  constexpr double turning_s = 10e-9;
  constexpr double bytes = 6.0 * sizeof(double) + 32.0;  // spin, torque; what it turned in the step
  return {.bytes = work.grains * bytes,
          .seconds = work.sand_steps * work.grains * turning_s,
          .memory = MemoryOf::particles,
          .more_seconds = true};
}

}  // namespace

Effect grain_rotation() {
  return {
      .name = "grain_rotation",
      .doc = "Friction turns the grains.",
      .rule = "off unless the case states it: the friction of the soils was chosen for grains that do not turn",
      .without = "grains only translate, as in the paper: they cannot roll, and the soil is stiffer in shear",
      .find = find,
      .cost = cost,
      .needs = "friction",
      .in_a_cell = true,
      .stages = {"grain_rotation"},
      .columns = {"sand_rotation_J"},
  };
}

}  // namespace standoff::effects
