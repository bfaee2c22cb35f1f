#include "coupling/launcher/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/case/effects/registry.hpp"
#include "coupling/case/particle_bytes.hpp"
#include "coupling/case/soil_body.hpp"
#include "coupling/case/structural_models.hpp"

namespace standoff::launch {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double cubic_points = 64.0;        // 4 x 4 x 4 Gauss points in a cubic hexahedron
constexpr double gauss_point_bytes = 200.0;  // per Gauss point

double cube(double x) {
  return x * x * x;
}

double speedup(int threads, const CostConstants& c) {
  return 1.0 + c.thread_efficiency * (threads - 1);
}

double sound_speed(const MaterialSpec& m) {
  const double nu = m.poissons_ratio;
  return std::sqrt(m.youngs_modulus * (1.0 - nu) / (m.density * (1.0 + nu) * (1.0 - 2.0 * nu)));
}

double sand_volume(const SoilSpec& soil) {
  return soil.kind == SoilKind::none ? 0.0 : SoilBody(soil, {}).volume();
}

double sand_mass(const SoilSpec& soil) {
  return sand_volume(soil) * soil.bulk_density;
}

/// Volume of the body that goes with one grain, m3.
double grain_cell(const SoilSpec& soil) {
  return sand_volume(soil) / static_cast<double>(soil.particles);
}

Vec3 element_edges(const PlateSpec& plate) {
  return {plate.size.x / plate.elements[0], plate.size.y / plate.elements[1], plate.size.z / plate.elements[2]};
}

/// Longest window in which the plate moves by a particle's radius (what the load side asks for), from Gurney's estimate
/// of the momentum that arrives at the plate's centre.
double particle_window(const CaseSpec& spec, double smallest_radius) {
  const ChargeSpec& charge = spec.charge;
  const double energy = charge.mass * charge.explosive.energy / charge.explosive.density;
  const double sand = sand_mass(spec.soil);
  const double speed = std::sqrt(2.0 * energy / (sand + 0.6 * charge.mass));
  const double area = 4.0 * pi * spec.run.stand_off * spec.run.stand_off;
  const double wall = (sand + 0.75 * charge.mass) * speed / area / (spec.plate.material.density * spec.plate.size.z);
  return smallest_radius / wall;
}

double gas_radius(const ChargeSpec& charge) {
  const double solid = charge.mass / charge.explosive.density;
  return std::cbrt(3.0 * charge.explosive.fill * solid / (4.0 * pi * static_cast<double>(charge.particles)));
}

double automatic_window(const CaseSpec& spec) {
  const double window = 2.0 * spec.plate.size.z / sound_speed(spec.plate.material);
  if (!spec.charge.present) return window;
  double radius = gas_radius(spec.charge);
  if (spec.soil.kind != SoilKind::none)
    radius = std::min(radius, std::cbrt(3.0 * spec.soil.packing * grain_cell(spec.soil) / (4.0 * pi)));
  return radius > 0.0 ? std::min(window, particle_window(spec, radius)) : window;  // points ask for nothing
}

void plan_windows(const CaseSpec& spec, const CostConstants& c, CostPrediction& p) {
  switch (spec.coupling.window_rule) {
    case CouplingSpec::Window::structure_step:
      p.window = p.structure_step;
      break;
    case CouplingSpec::Window::fixed:
      p.window = spec.coupling.window;
      break;
    case CouplingSpec::Window::automatic:
      p.window = automatic_window(spec);
      break;
  }
  p.windows = std::ceil(spec.run.until / p.window * (1.0 - 1e-9));
  const double nodes = (3.0 * spec.plate.elements[0] + 1) * (3.0 * spec.plate.elements[1] + 1) / p.copies;
  const double bytes = nodes * 9.0 * sizeof(double);  // positions, velocities, forces
  p.exchange_s = p.windows * (c.exchange_window + bytes * c.exchange_byte);
  p.structure_steps = p.windows * std::ceil(p.window / p.structure_step * (1.0 - 1e-9));
}

/// Gauss points that are simulated and keep a history.
double points_of(const CaseSpec& spec, const CostPrediction& p) {
  return structural_model(spec.plate.model).points * p.simulated(p.elements);
}

void plan_structure(const CaseSpec& spec, const CostConstants& c, CostPrediction& p) {
  const StructuralModelEntry& model = structural_model(spec.plate.model);
  const Vec3 edge = element_edges(spec.plate);
  const double shortest = std::min({edge.x, edge.y, edge.z});
  p.elements = static_cast<long>(spec.plate.elements[0]) * spec.plate.elements[1] * spec.plate.elements[2];
  p.structure_step =
      model.relative_step * c.structure_safety * c.hexahedron_courant * shortest / sound_speed(spec.plate.material);
  plan_windows(spec, c, p);
  const double cubic_steps = p.structure_steps * model.relative_step;  // what plate_hex64 would take
  p.structure_s = model.relative_cost * cubic_steps * cubic_points * p.simulated(p.elements) * c.gauss_point_step;
  const double points = points_of(spec, p);
  p.structure_bytes = points * gauss_point_bytes;
  if (spec.run.settle) p.relaxation_s = c.relaxation_calls * points * c.relaxation_call;
}

/// Speed of the boundary of the gas: its own head in vacuum, or the shell it drives.
double bubble_speed(const CaseSpec& spec, double thermal_speed, double energy_per_mass) {
  if (spec.soil.kind == SoilKind::none) return 2.0 * thermal_speed;
  return std::sqrt(2.0 * energy_per_mass / (sand_mass(spec.soil) / spec.charge.mass + 0.6));
}

void plan_gas(const CaseSpec& spec, const CostConstants& c, CostPrediction& p) {
  const Explosive& e = spec.charge.explosive;
  if (!spec.charge.present || spec.charge.particles <= 0) return;
  p.charge_particles = spec.charge.particles;
  const double count = static_cast<double>(spec.charge.particles);
  const double diameter = 2.0 * gas_radius(spec.charge);
  const double translational = std::min(1.0, 1.5 * (e.gamma - 1.0));
  const double speed = std::sqrt(2.0 * translational * e.energy / e.density);
  p.gas_step = diameter > 0.0 ? std::min(p.window, c.gas_step_fraction * diameter / speed) : p.window;

  const double growth = bubble_speed(spec, speed, e.energy / e.density);
  constexpr int pieces = 400;
  const double piece = spec.run.until / pieces;
  for (int i = 0; i < pieces; ++i) {
    const double radius = spec.charge.radius + growth * (i + 0.5) * piece;
    const double volume = 4.0 / 3.0 * pi * cube(radius);
    const double path = volume / (std::numbers::sqrt2 * pi * diameter * diameter * count);
    const double reach = std::max(c.gas_step_fraction * diameter, c.gas_path_fraction * path);
    p.gas_steps += piece / std::min(p.window, reach / speed);
  }
  p.gas_s = p.gas_steps * p.simulated(p.charge_particles) * c.gas_particle_step;
  p.particle_bytes += p.simulated(p.charge_particles) * gas_bytes;
}

void plan_sand(const CaseSpec& spec, const CostConstants& c, CostPrediction& p) {
  const SoilSpec& soil = spec.soil;
  if (soil.kind == SoilKind::none || soil.particles <= 0) return;
  p.sand_particles = soil.particles;
  const double volume = grain_cell(soil);
  const double mass = volume * soil.bulk_density;
  const double cell = std::cbrt(1000.0 * volume);
  p.sand_step = std::min(p.window, c.sand_step_fraction * 2.0 * std::sqrt(mass / (soil.stiffness * cell)));
  p.sand_steps = p.windows * std::ceil(p.window / p.sand_step * (1.0 - 1e-9));
  p.gas_steps = std::max(p.gas_steps, p.charge_particles > 0 ? p.sand_steps : 0.0);  // both move in the same sub-steps
  p.gas_s = p.gas_steps * p.simulated(p.charge_particles) * (c.gas_particle_step + c.gas_beside_sand);
  double price = c.grain_step;
  if (soil.friction > 0.0) price += c.grain_friction, p.particle_bytes += p.simulated(soil.particles) * history_bytes;
  if (soil.damping > 0.0) price += c.grain_damping;
  p.sand_s = p.sand_steps * p.simulated(soil.particles) * price;
  p.packing_s = 1000.0 * c.packing_grain;
  p.particle_bytes += p.simulated(soil.particles) * grain_bytes;
}

/// Air is awake inside the blast wave: Sedov's strong point explosion for gamma = 1.4, R = 1.03 (E t^2 / rho)^(1/5)
/// [Sedov, Similarity and Dimensional Methods in Mechanics (1959), ch. IV.11], never faster than what drives it.
void plan_air(const CaseSpec& spec, const CostConstants& c, CostPrediction& p) {
  if (!spec.air.on || !spec.charge.present) return;
  const Explosive& e = spec.charge.explosive;
  const Vec3 box = spec.domain.upper - spec.domain.lower;
  const double energy = spec.charge.mass / e.density * e.energy, volume = box.x * box.y * spec.domain.upper.z;
  const double driver =
      bubble_speed(spec, std::sqrt(3.0 * (e.gamma - 1.0) * e.energy / e.density), e.energy / e.density);
  const Vec3 sand = spec.soil.kind == SoilKind::none ? Vec3{} : SoilBody(spec.soil, {}).half_size();
  const double outer = std::max({spec.charge.radius, sand.x, sand.y, sand.z});
  const double density = static_cast<double>(spec.air.particles) / nominal_air_volume;
  p.air_particles = static_cast<long>(density * volume);
  p.air_steps = p.windows;
  constexpr int pieces = 100;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double t = spec.run.until * (i + 0.5) / pieces;
    const double radius = std::min(1.03 * std::pow(energy * t * t / spec.air.density, 0.2), outer + driver * t);
    p.awake_air = density * std::min(volume, 4.0 / 3.0 * pi * cube(radius));
    sum += p.awake_air / p.copies / pieces;
  }
  p.air_s = p.air_steps * sum * c.air_particle_step;
  p.particle_bytes += p.awake_air / p.copies * air_bytes;
}

/// The side that computes longer gets the cores; in the parallel scheme both compute at the same time.
void choose_threads(const CaseSpec& spec, int cores, CostPrediction& p) {
  const double particles = p.air_s + p.gas_s + p.sand_s, structure = p.structure_s;
  if (cores < 2 || spec.coupling.scheme == Scheme::serial || particles + structure <= 0.0) {
    p.particle_threads = p.structure_threads = cores;
    return;
  }
  // A core for a side that is idle most of the time is wasted: below two fifths of a core it shares with the other.
  constexpr double worth_a_core = 0.4;
  const double wanted = cores * structure / (particles + structure);
  int for_structure = std::clamp(static_cast<int>(std::lround(wanted)), 1, cores - 1);
  if (wanted < worth_a_core) for_structure = 0;
  if (cores - wanted < worth_a_core) for_structure = cores;
  p.structure_threads = std::max(1, for_structure);
  p.particle_threads = std::max(1, cores - for_structure);
}

void add_wall(const CaseSpec& spec, int cores, const CostConstants& c, CostPrediction& p) {
  const double particles = (p.air_s + p.gas_s + p.sand_s) / speedup(p.particle_threads, c);
  const double structure = p.structure_s / speedup(p.structure_threads, c);
  const bool at_once = spec.coupling.scheme == Scheme::parallel && cores > 1;
  double loading = particles + structure;
  if (at_once)
    loading = std::max({particles, structure, (p.air_s + p.gas_s + p.sand_s + p.structure_s) / speedup(cores, c)});
  p.wall_s = c.start_up + p.packing_s + loading + p.exchange_s + p.relaxation_s / speedup(p.structure_threads, c);
}

/// What overriding a decision would add to the price: minus what an effect takes that is on, what one would take that
/// is off and could be on.
EffectPrice price_of(const Effect& effect, const EffectDecision& decision, const CaseSpec& spec,
                     const SceneWork& work) {
  EffectPrice price;
  price.name = decision.name, price.on = decision.on, price.reason = decision.reason;
  const EffectCost cost = effect.cost != nullptr ? effect.cost(spec, work) : EffectCost{};
  price.memory = cost.memory, price.more_seconds = cost.more_seconds;
  if (decision.on) price.bytes = cost.bytes, price.seconds = std::max(0.0, cost.seconds);
  const bool switched = effect.switched_by != nullptr && cost.seconds > 0.0;
  const bool can_turn = decision.on ? !effect.inherent : effect.find(spec).possible || switched;
  if (!can_turn) return price;
  price.overriding = EffectCost{decision.on ? -cost.bytes : cost.bytes, decision.on ? -cost.seconds : cost.seconds};
  price.without = effect.without;
  if (!decision.on && switched) price.switched_by = effect.switched_by;
  return price;
}

/// The work of the scene; of air also where there is none, to price it.
SceneWork work_of(const CaseSpec& spec, const CostConstants& c, const CostPrediction& p) {
  CaseSpec in_air = spec;
  in_air.air.on = true;
  CostPrediction air = p;
  if (!spec.air.on) plan_air(in_air, c, air);
  SceneWork work;
  work.gas = p.simulated(p.charge_particles), work.grains = p.simulated(p.sand_particles);
  work.air = air.awake_air / p.copies, work.points = points_of(spec, p);
  work.sand_steps = p.sand_steps, work.copies = p.copies, work.all_s = p.core_s();
  work.gas_s = p.gas_s, work.air_s = air.air_s, work.sand_s = p.sand_s;
  work.structure_s = p.structure_s, work.relaxation_s = p.relaxation_s;
  return work;
}

}  // namespace

CostPrediction predict_cost(const CaseSpec& spec, int cores, int particle_threads, int structure_threads,
                            const CostConstants& constants) {
  CostPrediction p;
  p.copies = spec.copies();
  if (spec.plate.model == material_point_model) {  // no plate, no charge, no windows: milliseconds of curves
    for (const EffectDecision& effect : spec.effects)
      p.effects.emplace_back().name = effect.name, p.effects.back().on = effect.on,
      p.effects.back().reason = effect.reason;
    p.particle_threads = 0, p.structure_threads = 1, p.wall_s = constants.start_up;
    return p;
  }
  plan_structure(spec, constants, p);
  plan_gas(spec, constants, p);
  plan_sand(spec, constants, p);
  plan_air(spec, constants, p);
  const SceneWork work = work_of(spec, constants, p);
  for (const EffectDecision& decision : spec.effects)
    for (const Effect& effect : effect_rules())
      if (decision.name == effect.name) p.effects.push_back(price_of(effect, decision, spec, work));
  for (const EffectPrice& price : p.effects) {
    if (price.memory == MemoryOf::structure) p.structure_bytes += price.bytes;
    if (price.memory == MemoryOf::particles) p.particle_bytes += price.bytes;
    if (price.more_seconds) p.sand_s += price.seconds;
  }
  choose_threads(spec, cores, p);
  if (particle_threads > 0) p.particle_threads = particle_threads;
  if (structure_threads > 0) p.structure_threads = structure_threads;
  add_wall(spec, cores, constants, p);
  return p;
}

}  // namespace standoff::launch
