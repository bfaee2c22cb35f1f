// Effect hard_core: grains pressed deeper than half a radius bounce.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "coupling/case/effects/effect.hpp"

namespace standoff::effects {
namespace {

/// A linear spring is pressed by v (m/2k)^(1/2) when two equal grains meet with v [energy: m_red v^2/2 = k s^2/2]. With
/// k = (L/L0) k0, N spheres of fill phi in a cell of edge L, it is the same share of a radius at any number of grains:
///   s/r = v ((4 pi/3) rho_grain / (2 k0 c))^(1/2),  c = L/r = (4 pi N/(3 phi))^(1/3),  N = 1000 [Borvik 2011,
///   sec. 3.3]
/// The fastest grains are those that the front of the products throws: v = 2 m_gas/(m_gas + m_grain) v_front, elastic,
/// with the speed of an expansion into vacuum, v_front = 2 (gamma E0/((gamma - 1) rho0))^(1/2) [Zel'dovich, Raizer
/// 1966, ch. I].
EffectFinding find(const CaseSpec& spec) {
  const SoilSpec& s = spec.soil;
  const ChargeSpec& c = spec.charge;
  if (!has_sand(spec)) return nothing("there is no sand");
  if (!c.present || c.particles < 1 || s.particles < 1) return nothing("nothing throws the grains");
  const double sphere = 4.0 / 3.0 * std::numbers::pi, cell = std::cbrt(1000.0 * sphere / s.packing);
  const double per_speed = std::sqrt(sphere * s.grain_density / (2.0 * s.stiffness * cell));
  const double gas = c.mass / static_cast<double>(c.particles);
  const double grain = soil_mass(s) / static_cast<double>(s.particles);
  const double g = c.explosive.gamma, energy = c.explosive.energy / c.explosive.density;
  const double front = 2.0 * std::sqrt(g / (g - 1.0) * energy), thrown = 2.0 * gas / (gas + grain) * front;
  const double overlap = thrown * per_speed;
  return {true, overlap > 0.5,
          fmt::format(
              "products at {:.2g} km/s throw grains at {:.2g} km/s: v (m/2k)^(1/2) is {:.2g} radii, the core begins "
              "at 0.5",
              1e-3 * front, 1e-3 * thrown, overlap)};
}

EffectCost cost(const CaseSpec&, const SceneWork& work) {
  // s a grain and step: the look into blocks with deep contacts, and the fastest grain for the step. Row hard_core of
  // the stages, 0.07 to 0.11 s of 3.2e7 steps of a grain on an AMD EPYC core [standoff run cases/borvik_2011/dry_150mm
  // --level coarse --threads 1 --set run.until="0.5 ms"], and 1e-9 for the pass over the speeds.
  constexpr double bounce_s = 4e-9;
  return {.seconds = work.sand_steps * work.grains * bounce_s};
}

}  // namespace

Effect hard_core() {
  return {
      .name = "hard_core",
      .doc = "Grains pressed deeper than half a radius bounce.",
      .rule = "on if the fastest grains would press a contact deeper than half a radius: v (m/2k)^(1/2) / r > 0.5",
      .without = "fast grains fly through each other: overlaps of more than a radius near the cavity",
      .find = find,
      .cost = cost,
      .stages = {"hard_core"},
  };
}

}  // namespace standoff::effects
