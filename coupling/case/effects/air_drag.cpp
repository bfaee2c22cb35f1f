// Effect air_drag: still air brakes the grains that fly through it.
#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

/// A sphere of diameter d loses 1 - exp(-s/l) of its speed on a way s, l = 4 d rho_grain / (3 C_D rho_air), C_D = 0.44
/// [Clift, Grace & Weber 1978, ch. 5]. The grain is the simulated one: a coarse grain stands for a cloud that flies as
/// one. A cloud shields its inside, so this is the most that air can take.
EffectFinding find(const CaseSpec& spec) {
  const SoilSpec& s = spec.soil;
  if (!has_sand(spec) || s.particles < 1) return nothing("there is no sand");
  if (spec.air.on) return nothing("air is simulated, and brakes the grains by its hits");
  const double grain = soil_mass(s) / static_cast<double>(s.particles);
  const double diameter = 2.0 * std::cbrt(3.0 * grain / (4.0 * 3.141592653589793 * s.grain_density));
  const double length = 4.0 * diameter * s.grain_density / (3.0 * 0.44 * spec.air.density);
  const double loss = 1.0 - std::exp(-spec.run.stand_off / length);
  return {true, loss > 0.05,
          fmt::format("a grain of {:.2g} mm loses {:.2g} % of its speed to still air over {:.3g} mm", 1e3 * diameter,
                      100.0 * loss, 1e3 * spec.run.stand_off)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  constexpr double drag_s = 10e-9;  // s a grain and step: one pass over the velocities, a power of Re below 1000
  return {.seconds = work.sand_steps * work.grains * drag_s};
}

}  // namespace

Effect air_drag() {
  return {
      .name = "air_drag",
      .doc = "Still air brakes the grains that fly through it.",
      .rule = "on if a grain would lose more than 5 % of its speed on its way to the plate",
      .without = "grains reach the plate as fast as they left",
      .find = find,
      .cost = cost,
      .stages = {"air_drag"},
      .columns = {"air_drag_loss_J"},
  };
}

}  // namespace standoff::effects
