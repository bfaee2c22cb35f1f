#include "coupling/case/effect_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "coupling/case/structural_models.hpp"

namespace standoff {
namespace {

/// Rough figures of a scene for the criteria; factors of two do not matter.
struct Estimate {
  double mass = 0.0;        // kg, charge and sand
  double speed = 0.0;       // m/s, all energy as motion of all mass: sqrt(2 E / M)
  double arriving = 0.0;    // kg/m2, mass spread over the sphere of radius stand_off
  double plate = 0.0;       // kg/m2
  double wall_speed = 0.0;  // m/s, of the plate after a plastic impact of what arrives at its centre
  double rate = 0.0;        // 1/s, wall speed over the half width
  double heating = 0.0;     // K, if the plate's kinetic energy becomes plastic work: chi v^2 / (2 cp)
};

Estimate estimate(const CaseSpec& spec) {
  Estimate e;
  const ChargeSpec& c = spec.charge;
  const SoilSpec& s = spec.soil;
  const MaterialSpec& m = spec.plate.material;
  if (!c.present || spec.run.stand_off <= 0.0) return e;
  const double shell = std::pow(s.outer_radius, 3) - std::pow(s.inner_radius, 3);
  e.mass = c.mass + (s.kind == SoilKind::none ? 0.0 : s.bulk_density * 4.0 / 3.0 * std::numbers::pi * shell);
  e.speed = std::sqrt(2.0 * c.mass / c.explosive.density * c.explosive.energy / e.mass);
  e.arriving = e.mass / (4.0 * std::numbers::pi * spec.run.stand_off * spec.run.stand_off);
  e.plate = m.density * spec.plate.size.z;
  e.wall_speed = e.speed * e.arriving / (e.arriving + e.plate);
  e.rate = e.wall_speed / (0.5 * std::min(spec.plate.size.x, spec.plate.size.y));
  e.heating = m.specific_heat > 0.0 ? m.taylor_quinney * e.wall_speed * e.wall_speed / (2.0 * m.specific_heat) : 0.0;
  return e;
}

double soil_mass(const SoilSpec& s) {
  const double shell = std::pow(s.outer_radius, 3) - std::pow(s.inner_radius, 3);
  return s.bulk_density * 4.0 / 3.0 * std::numbers::pi * shell;
}
bool has_sand(const CaseSpec& spec) {
  return spec.soil.kind != SoilKind::none;
}
EffectFinding nothing(const char* why) {
  return {false, false, why};
}

// ---- gas ----
EffectFinding detonation_timing(const CaseSpec& spec) {
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

EffectFinding internal_energy(const CaseSpec& spec) {
  if (!spec.charge.present) return nothing("there is no gas");
  const double gamma = spec.charge.explosive.gamma, share = 1.5 * (gamma - 1.0);
  if (share > 1.0 - 1e-9) return nothing("gamma = 5/3: all energy is motion");
  return {true, true,
          fmt::format("gamma = {:.4g}: {:.0f} % of the energy is motion, the rest rotation and vibration", gamma,
                      100.0 * share)};
}

EffectFinding co_volume(const CaseSpec& spec) {
  if (!spec.charge.present) return nothing("there is no gas");
  const double b = spec.charge.explosive.fill;
  if (b <= 0.0) return nothing("fill = 0: points without volume");
  // Carnahan and Starling, J. Chem. Phys. 51 (1969) 635, eq. 10.
  const double z = (1.0 + b + b * b - b * b * b) / std::pow(1.0 - b, 3);
  return {true, true, fmt::format("fill = {:.3g}: sphere volume raises the first pressure {:.2g}-fold", b, z)};
}

EffectFinding air(const CaseSpec& spec) {
  if (!spec.air.on) return nothing("air.mode = \"off\": nothing around charge and plate");
  return {true, true,
          fmt::format("air.mode = \"on\": {:.4g} kg/m3 at {:.4g} Pa, simulated where it does not stand still",
                      spec.air.density, spec.air.pressure)};
}

EffectFinding ambient_pressure(const CaseSpec& spec) {
  if (!spec.air.on) return nothing("there is no air");
  return {
      true, true,
      fmt::format("{:.4g} Pa on the rear of the plate: {:.3g} N s over the run, as much as still air gives its front",
                  spec.air.pressure, spec.air.pressure * spec.plate.size.x * spec.plate.size.y * spec.run.until)};
}

// ---- sand ----
EffectFinding friction(const CaseSpec& spec) {
  if (!has_sand(spec)) return nothing("there is no sand");
  const double mu = spec.soil.friction;
  if (mu <= 0.0) return nothing("mu = 0: no tangential history is stored");
  return {true, true, fmt::format("mu = {:.3g} > 0: tangential history is stored", mu)};
}

EffectFinding damping(const CaseSpec& spec) {
  if (!has_sand(spec)) return nothing("there is no sand");
  const double xi = spec.soil.damping;
  if (xi <= 0.0) return nothing("xi = 0: contacts are elastic");
  return {true, true, fmt::format("xi = {:.3g} of critical: contacts dissipate", xi)};
}

EffectFinding radius_spread(const CaseSpec& spec) {
  if (!has_sand(spec)) return nothing("there is no sand");
  const double spread = spec.soil.radius_spread;
  if (spread <= 0.0) return nothing("equal grains: no array of radii");
  return {true, true, fmt::format("radii spread by +-{:.3g} %: every grain has its own", 100.0 * spread)};
}

/// A linear spring is pressed by v (m/2k)^(1/2) when two equal grains meet with v [energy: m_red v^2/2 = k s^2/2]. With
/// k = (L/L0) k0, N spheres of fill phi in a cell of edge L, it is the same share of a radius at any number of grains:
///   s/r = v ((4 pi/3) rho_grain / (2 k0 c))^(1/2),  c = L/r = (4 pi N/(3 phi))^(1/3),  N = 1000 [Borvik 2011,
///   sec. 3.3]
/// The fastest grains are those that the front of the products throws: v = 2 m_gas/(m_gas + m_grain) v_front, elastic,
/// with the speed of an expansion into vacuum, v_front = 2 (gamma E0/((gamma - 1) rho0))^(1/2) [Zel'dovich, Raizer
/// 1966, ch. I, sec. 11].
EffectFinding hard_core(const CaseSpec& spec) {
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

// ---- scene ----
EffectFinding symmetry(const CaseSpec& spec) {
  const bool quarter = spec.run.quarter_symmetry;
  return {true, quarter,
          quarter ? "run.symmetry = \"quarter\": mirror planes x = 0 and y = 0, a quarter of the work"
                  : "run.symmetry = \"none\": everything is computed"};
}

EffectFinding surface_recession(const CaseSpec& spec) {
  const Estimate e = estimate(spec);
  if (e.mass <= 0.0 || e.plate <= 0.0) return nothing("nothing loads the plate");
  const double ratio = e.arriving / (e.arriving + e.plate);
  return {true, ratio > 0.001,
          fmt::format("{:.2g} kg/m2 arrive at a plate of {:.3g} kg/m2: it recedes at {:.2g} % of their speed",
                      e.arriving, e.plate, 100.0 * ratio)};
}

// ---- plate ----
bool yields(const CaseSpec& spec) {
  return spec.plate.material.law != MaterialLaw::elastic;
}

EffectFinding plasticity(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("law = \"elastic\": no yield stress");
  const MaterialSpec& m = spec.plate.material;
  const double impact = estimate(spec).wall_speed * std::sqrt(m.youngs_modulus * m.density);
  return {true, true,
          fmt::format("yields at {:.0f} MPa; the wall speed alone is a bar stress of {:.2g} MPa", 1e-6 * m.A,
                      1e-6 * impact)};
}

EffectFinding hardening(const CaseSpec& spec) {
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

EffectFinding strain_rate(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("the plate does not yield");
  const MaterialSpec& m = spec.plate.material;
  if (m.C <= 0.0) return nothing("C = 0: yield stress does not depend on strain rate");
  const double relative = estimate(spec).rate / m.reference_rate;
  const double factor = m.law == MaterialLaw::johnson_cook_log ? 1.0 + m.C * std::log(std::max(relative, 1.0))
                                                               : std::pow(1.0 + relative, m.C);
  return {true, factor > 1.01,
          fmt::format("about {:.2g} 1/s raises the yield stress by {:.2g} %", relative * m.reference_rate,
                      100.0 * (factor - 1.0))};
}

EffectFinding heating(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("the plate does not yield");
  const MaterialSpec& m = spec.plate.material;
  if (m.taylor_quinney <= 0.0) return nothing("chi = 0: plastic work does not heat");
  const double rise = estimate(spec).heating;
  const double softening = std::pow(rise / (m.melting_temperature - m.room_temperature), m.m);
  return {true, softening > 0.001,
          fmt::format("plastic work heats by about {:.2g} K, which takes {:.2g} % off the yield stress", rise,
                      100.0 * softening)};
}

EffectFinding expansion(const CaseSpec& spec) {
  if (!yields(spec)) return nothing("the plate does not yield, so it stays cold");
  const MaterialSpec& m = spec.plate.material;
  if (m.thermal_expansion <= 0.0) return nothing("alpha = 0: heat does not strain");
  const double strain = m.thermal_expansion * estimate(spec).heating, yield = m.A / m.youngs_modulus;
  return {true, strain > 0.05 * yield,
          fmt::format("thermal strain of about {:.1e} against {:.1e} at yield", strain, yield)};
}

EffectFinding relaxation(const CaseSpec& spec) {
  if (spec.plate.model == material_point_model)
    return nothing("one material point: there is no plate to bring to rest");
  return {true, spec.run.settle,
          spec.run.settle ? "run.settle: the plate is brought to rest for its permanent shape"
                          : "run.settle = false: the run ends while the plate moves"};
}

}  // namespace

const std::vector<EffectRule>& effect_rules() {
  static const std::vector<EffectRule> rules{
      {"detonation_timing", "Gas particles are released when the detonation front reaches them.", detonation_timing},
      {"internal_energy", "Gas particles exchange energy of rotation and vibration in collisions.", internal_energy},
      {"co_volume", "Gas particles are spheres with a volume of their own.", co_volume},
      {"air", "Ambient air around charge and plate.", air},
      {"ambient_pressure", "Ambient pressure on the rear of the plate.", ambient_pressure},
      {"friction", "Coulomb friction between grains.", friction},
      {"damping", "Normal dashpot between grains.", damping},
      {"radius_spread", "Grains of different size.", radius_spread},
      {"hard_core", "Grains pressed deeper than half a radius bounce.", hard_core},
      {"symmetry", "One quarter between two mirror planes.", symmetry},
      {"surface_recession", "Particles meet the plate where it has moved to.", surface_recession},
      {"plasticity", "The plate yields; without, it is elastic and holds no history.", plasticity},
      {"hardening", "Yield stress grows with plastic strain.", hardening},
      {"strain_rate", "Yield stress grows with strain rate.", strain_rate},
      {"heating", "Plastic work heats the plate and softens it.", heating},
      {"expansion", "A heated plate expands.", expansion},
      {"relaxation", "The plate is brought to rest after the particle phase.", relaxation}};
  return rules;
}

const std::vector<std::string>& effect_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const EffectRule& rule : effect_rules()) list.push_back(rule.name);
    return list;
  }();
  return names;
}

namespace {

/// Without plastic flow nothing hardens, and nothing is heated by it.
void leave_out_what_needs_flow(std::vector<EffectDecision>& effects) {
  const auto named = [&](std::string_view name) { return std::ranges::find(effects, name, &EffectDecision::name); };
  if (named("plasticity")->on) return;
  for (const char* name : {"hardening", "strain_rate", "heating", "expansion"})
    if (EffectDecision& effect = *named(name); effect.on) effect.on = false, effect.reason = "plasticity is off";
}

}  // namespace

EffectDecisions decide_effects(const CaseSpec& spec, const std::map<std::string, bool>& stated) {
  EffectDecisions decisions;
  for (const EffectRule& rule : effect_rules()) {
    const EffectFinding finding = rule.find(spec);
    EffectDecision decision{rule.name, finding.possible && finding.wanted, finding.reason, false};
    if (const auto it = stated.find(rule.name); it != stated.end()) {
      decision.overridden = true;
      decision.on = it->second && finding.possible;
      if (it->second && !finding.possible) decisions.idle.push_back(rule.name);
      decision.reason =
          (it->second && !finding.possible ? "stated by the case, but " : "stated by the case; ") + finding.reason;
    }
    decisions.effects.push_back(std::move(decision));
  }
  leave_out_what_needs_flow(decisions.effects);
  return decisions;
}

bool CaseSpec::effect(const std::string& effect_name) const {
  for (const EffectDecision& decision : effects)
    if (decision.name == effect_name) return decision.on;
  throw std::out_of_range("there is no effect named " + effect_name);
}

}  // namespace standoff
