#include "particle_solver/step/time_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle_solver/step/detonate.hpp"
#include "particle_solver/step/gas_drift.hpp"
#include "particle_solver/step/grain_rotation.hpp"
#include "particle_solver/step/sand_integrate.hpp"
#include "particle_solver/step/wrap.hpp"

namespace standoff::particles {
namespace {

BoundaryOptions boundary_options(const CaseSpec& spec, int threads) {
  const DomainSpec& domain = spec.domain;
  return {domain.lower, domain.upper, spec.run.quarter_symmetry, threads, domain.closed(), domain.repeats()};
}

GasCollideOptions gas_options(const CaseSpec& spec, int threads) {
  GasCollideOptions options;
  options.internal_energy = spec.effect("internal_energy");
  options.seed = spec.run.seed;
  options.mirrors.on = spec.run.quarter_symmetry;
  options.walls = reflecting_planes(false, spec.domain.closed(), spec.domain.lower, spec.domain.upper);
  options.periodic = periodic_sides(spec.domain.repeats(), spec.domain.lower, spec.domain.upper);
  options.threads = threads;
  return options;
}

double fastest(const std::vector<Vec3>& velocities) {
  double square = 0.0;
  for (const Vec3& v : velocities) square = std::max(square, squared_norm(v));
  return std::sqrt(square);
}

/// Number of equal steps that fill `span` with none above `limit`.
long steps_to_fill(double span, double limit) {
  return std::max(1L, static_cast<long>(std::ceil(span / limit * (1.0 - 1e-12))));
}

}  // namespace

TimeLoop::TimeLoop(const CaseSpec& spec, Scene& scene, int threads)
    : scene_(scene), boundaries_(boundary_options(spec, threads)), threads_(threads) {
  sides_ = periodic_sides(spec.domain.repeats(), spec.domain.lower, spec.domain.upper);
  if (scene.has_gas) {
    gas_ = std::make_unique<GasCollide>(gas_options(spec, threads));
    gas_step_ = gas_->suggest_step(scene.gas, last_gas_, 0.0, std::min(spec.run.until, image_step_limit()));
  }
  if (scene.has_sand) {
    pairs_ = std::make_unique<SandPairs>(*scene.sand_law);
    pairs_->forces(scene.sand, 0.0);
    contact_ = std::make_unique<SurfaceContact>(surface_contact_options(spec, scene.sand_law->law.stiffness, threads));
    totals_.contact_elastic = contact_->stored_energy(scene.sand, scene.sheet);
    if (spec.effect("hard_core")) hard_core_ = std::make_unique<HardCore>();
    effects_ = particle_effects(spec, threads);
    if (spec.effect("drop_outgoing")) drop_outgoing_ = std::make_unique<DropOutgoing>(scene.sand, scene.centre);
  }
  if (scene.has_air) {
    air_collide_ = std::make_unique<AirCollide>(spec.run.seed, threads);
    air_drift_ = std::make_unique<AirDrift>(
        reflecting_planes(spec.run.quarter_symmetry, spec.domain.closed(), spec.domain.lower, spec.domain.upper),
        threads, sides_);
    air_boundaries_ =
        std::make_unique<AirBoundaries>(AirBoundariesOptions{spec.run.seed, spec.effect("ambient_pressure"), sides_});
  }
  compose();
}

TimeLoop::~TimeLoop() = default;

int TimeLoop::timer_row(const std::string& name) {
  const auto& rows = timers_.rows();
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return static_cast<int>(i);
  return timers_.add(name);
}

void TimeLoop::add(std::vector<Stage>& list, const std::string& name, Stage body) {
  const int row = timer_row(name);
  list.push_back(
      [this, row, body = std::move(body)](double time, double h) { timers_.time(row, [&] { body(time, h); }); });
}

void TimeLoop::compose() {
  SandState* sand = scene_.has_sand ? &scene_.sand : nullptr;
  GasState* gas = scene_.has_gas ? &scene_.gas : nullptr;
  auto kick = [this](double, double h) { half_kick(scene_.sand, h, threads_); };
  auto turn = [this](double, double h) { half_turn(scene_.sand, h, threads_); };
  const bool turning = sand && !sand->spin.empty();
  if (sand) {
    add(begin_step_, "sand_integrate", kick);
    if (turning) add(begin_step_, "grain_rotation", turn);
    for (const auto& effect : effects_)
      add(begin_step_, effect->name(), [this, one = effect.get()](double, double h) { one->run(scene_.sand, h); });
    add(begin_step_, "surface_contact", [this](double, double h) {
      const SurfaceContactCounts now = contact_->run(scene_.sand, scene_.sheet, h);
      totals_.impulse_sand += now.plate_impulse;
      totals_.incoming += now.plate_incoming;
      totals_.contact_loss += now.loss;
      totals_.contact_elastic = now.elastic_energy;
      totals_.max_penetration_over_radius = std::max(totals_.max_penetration_over_radius, now.penetration_over_radius);
    });
  }
  // Between the half kick and the drift no force is pending: a grain may leave without its neighbours losing momentum.
  add(begin_step_, "boundaries", [this, gas, sand](double, double) {
    const BoundaryChanges& out = boundaries_.run(gas, sand, &scene_.sheet, books_);
    if (sand == nullptr) return;
    const double pressed = contact_->stored_in(out.sand);  // on the plate, by the soil's own law
    totals_.contact_elastic -= pressed, totals_.escaped_contact += pressed;
  });
  if (drop_outgoing_)  // what flies past the plate does not touch it
    add(begin_step_, "drop_outgoing", [this](double, double) {
      boundaries_.take_out(scene_.sand, drop_outgoing_->find(scene_.sand, scene_.sheet), books_);
    });
  if (scene_.sheet.recedes() && (gas != nullptr || scene_.has_air))
    add(begin_window_, "surface_carry", [this, gas](double, double) {
      if (gas != nullptr) surface_carry(*gas, scene_.sheet, threads_, totals_.carried);
      if (scene_.has_air) surface_carry(scene_.air->particles, scene_.sheet, threads_, totals_.carried);
    });
  if (scene_.has_air) compose_air();
  if (gas) {
    if (!gas->all_released())
      add(sub_step_, "detonate", [this](double time, double) { detonate(scene_.gas, time, &gas_->idle_grid()); });
    add(sub_step_, "gas_collide", [this, sand](double, double h) {
      last_gas_ = gas_->run(scene_.gas, sand, &scene_.sheet, h, static_cast<std::uint32_t>(totals_.sub_steps));
      totals_.impulse_gas += last_gas_.plate_impulse;
      totals_.incoming += last_gas_.plate_incoming;
      totals_.deferred_hits += last_gas_.deferred;
      books_.mirror_impulse += last_gas_.mirror_impulse;
    });
    add(sub_step_, "gas_drift", [this, sand](double, double h) { gas_drift(scene_.gas, sand, &scene_.sheet, h); });
  } else {
    add(sub_step_, "sand_integrate", [this](double, double h) {
      drift(scene_.sand, h, threads_);
      scene_.sheet.drift(h);
    });
  }
  if (sides_.on()) add(end_step_, "wrap", [this, gas, sand](double, double) { wrap(sides_, gas, sand); });
  if (sand) {
    add(end_step_, "sand_pairs", [this](double, double h) { pairs_->forces(scene_.sand, h); });
    add(end_step_, "sand_integrate", kick);
    if (turning) add(end_step_, "grain_rotation", turn);
  }
  if (hard_core_)
    add(end_step_, "hard_core", [this](double, double) {
      const HardCoreCounts now = hard_core_->run(scene_.sand, *pairs_);
      totals_.hard_core_hits += now.hits;
      books_.mirror_impulse += now.mirror_impulse;
    });
}

void TimeLoop::compose_air() {
  SandState* sand = scene_.has_sand ? &scene_.sand : nullptr;
  GasState* gas = scene_.has_gas ? &scene_.gas : nullptr;
  const auto number = [this] { return static_cast<std::uint32_t>(totals_.steps); };
  add(begin_window_, "air_collide",
      [this, gas, number](double, double h) { air_collide_->run(*scene_.air, gas, h, number()); });
  add(begin_window_, "air_drift", [this, sand](double, double h) {
    const AirDriftCounts now = air_drift_->run(*scene_.air, sand, &scene_.sheet, h);
    totals_.impulse_air += now.plate_impulse;
    totals_.incoming += now.plate_incoming;
    books_.mirror_impulse += now.mirror_impulse;
  });
  add(begin_window_, "air_boundaries", [this, gas, sand, number](double, double h) {
    totals_.impulse_air +=
        air_boundaries_->run(*scene_.air, gas, sand, &scene_.sheet, boundaries_, books_, h, number());
    totals_.particle_steps += static_cast<long>(scene_.air->particles.size());
  });
}

double TimeLoop::sand_step_limit() const {
  if (!pairs_) return std::numeric_limits<double>::infinity();
  const double step = pairs_->stable_step();
  return hard_core_ ? std::min(step, HardCore::longest_step(scene_.sand)) : step;
}

double TimeLoop::stable_step() const {
  const double gas = gas_ ? gas_step_ : std::numeric_limits<double>::infinity();
  return std::min(gas, sand_step_limit());
}

long TimeLoop::gas_steps(double dt) {
  return gas_ && scene_.gas.size() > 0 ? steps_to_fill(dt, gas_step_) : 1;
}

void TimeLoop::step(double time, double dt, long gas_steps) {
  for (const Stage& stage : begin_step_) stage(time, dt);
  const double h = dt / static_cast<double>(gas_steps);
  for (long i = 0; i < gas_steps; ++i) {
    for (const Stage& stage : sub_step_) stage(time + static_cast<double>(i) * h, h);
    ++totals_.sub_steps;
    totals_.particle_steps += static_cast<long>(scene_.gas.size());
  }
  if (gas_ && scene_.gas.size() > 0)
    gas_step_ = gas_->suggest_step(scene_.gas, last_gas_, gas_step_, std::min(gas_step_cap_, image_step_limit()));
  for (const Stage& stage : end_step_) stage(time, dt);
  totals_.particle_steps += static_cast<long>(scene_.sand.size());
  ++totals_.steps;
  totals_.step = h;
  totals_.limited_by = gas_steps > 1 ? "gas_collide" : (scene_.has_sand ? "sand_pairs" : "window");
}

/// Nothing flies farther than a cell of the air before it meets what is there.
double TimeLoop::air_step_limit() const {
  const Air& air = *scene_.air;
  const double speed = std::max(fastest(scene_.gas.velocity), fastest(air.particles.velocity));
  const double cell = air.cells.width().z;
  return speed > 0.0 ? cell / speed : std::numeric_limits<double>::infinity();
}

/// In a scene that repeats nothing flies farther than an eighth of the way to its own image, so that the image which is
/// nearest at the start of a sub-step is the one that is met.
double TimeLoop::image_step_limit() const {
  if (!sides_.on()) return std::numeric_limits<double>::infinity();
  const double speed = std::max(fastest(scene_.gas.velocity), fastest(scene_.sand.velocity));
  return speed > 0.0 ? 0.125 * sides_.period.shortest() / speed : std::numeric_limits<double>::infinity();
}

void TimeLoop::fill(double begin, double span) {
  const double end = begin + span;
  double time = begin;
  while (end - time > 1e-9 * span) {
    // A sand step, or what the gas alone asks for; equal parts of what is left, so that no sliver remains.
    const double limit = pairs_ && scene_.sand.size() > 0 ? sand_step_limit() : stable_step();
    const long count = steps_to_fill(end - time, limit);
    const double dt = (end - time) / static_cast<double>(count);
    step(time, dt, gas_steps(dt));
    time = count == 1 ? end : time + dt;
  }
}

void TimeLoop::advance(double begin, double window) {
  gas_step_cap_ = window;
  const long parts = scene_.has_air ? steps_to_fill(window, air_step_limit()) : 1;
  const double span = window / static_cast<double>(parts);
  for (long part = 0; part < parts; ++part) {
    const double from = begin + static_cast<double>(part) * span;
    for (const Stage& stage : begin_window_) stage(from, span);
    fill(from, span);
  }
}

const SandBooks& TimeLoop::sand_books() const {
  return pairs_->books();
}

ParticleEnergy TimeLoop::energy() const {
  ParticleEnergy energy;
  if (scene_.has_gas) {
    const GasTotals gas = gas_totals(scene_.gas);
    energy.gas_kinetic = gas.kinetic;
    energy.gas_internal = gas.internal + gas.waiting;
  }
  if (scene_.has_sand) {
    energy.sand_kinetic = kinetic_energy(scene_.sand);
    energy.sand_rotation = rotation_energy(scene_.sand);
    energy.sand_elastic = pairs_->books().elastic_energy + totals_.contact_elastic;
    energy.friction_loss = pairs_->books().friction_loss;
    energy.damping_loss = pairs_->books().damping_loss;
    energy.contact_loss = totals_.contact_loss;
    for (const auto& effect : effects_) energy.effect_loss += effect->books.loss;
  }
  if (scene_.has_air) {
    const GasTotals air = gas_totals(scene_.air->particles);
    energy.air_kinetic = air.kinetic;
    energy.air_internal = air.internal;
    energy.inflow = books_.inflow_energy;
  }
  const BoundaryTotals& out = boundaries_.totals();
  energy.escaped_gas = out.gas_energy;
  energy.escaped_sand = out.sand_energy + totals_.escaped_contact + (pairs_ ? pairs_->books().escaped_elastic : 0.0);
  if (scene_.has_air) energy.escaped_air = books_.escaped_energy - out.gas_energy - out.sand_energy;
  energy.work_to_structure = scene_.sheet.total_work();
  return energy;
}

Vec3 TimeLoop::momentum_everywhere() const {
  Vec3 sum =
      books_.mirror_impulse + books_.escaped_momentum + scene_.sheet.total_impulse() + scene_.sheet.surround_impulse();
  if (scene_.has_gas) sum += gas_totals(scene_.gas).momentum;
  if (scene_.has_air) sum += gas_totals(scene_.air->particles).momentum - books_.inflow_momentum;
  if (scene_.has_sand) sum += momentum(scene_.sand) + pairs_->books().mirror_impulse;
  for (const auto& effect : effects_) sum += effect->books.momentum;
  return sum;
}

double TimeLoop::impulse_scale() const {
  double scale = norm(books_.mirror_impulse) + norm(books_.escaped_momentum) + norm(scene_.sheet.total_impulse()) +
                 norm(scene_.sheet.surround_impulse());
  if (scene_.has_sand) scale += norm(pairs_->books().mirror_impulse);
  for (const auto& effect : effects_) scale += norm(effect->books.momentum);
  if (scene_.has_air) scale += norm(books_.inflow_momentum);
  return scale;
}

double TimeLoop::rebound() const {
  double sum = boundaries_.totals().gas_rebound + boundaries_.totals().sand_rebound;
  if (scene_.has_air)
    for (const double p : scene_.air->particles.plate_rebound) sum += std::isnan(p) ? 0.0 : p;
  for (const double p : scene_.gas.plate_rebound) sum += std::isnan(p) ? 0.0 : p;
  for (const double p : scene_.sand.plate_rebound) sum += std::isnan(p) ? 0.0 : p;
  return sum;
}

}  // namespace standoff::particles
