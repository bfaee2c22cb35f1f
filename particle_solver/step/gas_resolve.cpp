// Carries out the hits that are due in a round. Pairs of gas bodies share nothing with each other, so they run in
// parallel; whatever many bodies may hit at once (a grain, an unreleased particle, the sheet, the mirror's books) goes
// in a fixed order.
#include <algorithm>
#include <limits>
#include <tuple>

#include "particle_solver/kernels/gas_pair_impulse.hpp"
#include "particle_solver/kernels/gas_release.hpp"
#include "particle_solver/kernels/larsen_borgnakke.hpp"
#include "particle_solver/step/gas_work.hpp"

namespace standoff::particles::gas {
namespace {

// A pair costs about 0.3 us; fewer than this are not worth waking threads for. No effect on bits.
constexpr std::size_t worth_threads = 1000;

/// The hits of a round by what is hit.
struct Due {
  std::vector<Index> pairs, grains, unreleased, planes,
      sheet;  // grains by place of the grain, the others by place of the body, pairs by one of the two
};

Vec3 nearest(const Work& work, const Vec3& gap) {
  return work.periodic.on() ? nearest_image(gap, work.periodic.period) : gap;
}

CounterRandom random_of_pair(const Work& work, Index id_a, Index id_b) {
  const std::uint64_t seed = work.seed + (static_cast<std::uint64_t>(work.round) << 32);
  return {seed, RandomUse::internal_energy, std::min(id_a, id_b), std::max(id_a, id_b), work.step};
}

/// Rounded up.
float raised(double value) {
  return static_cast<float>(value * (1.0 + 0x1p-22));
}

/// A body's velocity changes at `time`.
void deflect(Work& work, Index p, const Vec3& change, double time) {
  const Index i = work.source(p);
  const Vec3 before = middle_of_path(work.path(p), work.h);
  change_velocity(work.gas->position[i], work.gas->velocity[i], change, time);
  work.since[p] = time;
  work.moved[p] = raised(work.moved[p] + norm(middle_of_path(work.path(p), work.h) - before));
}

void deflect_grain(Work& work, Index q, const Vec3& change, double time) {
  Grain& grain = work.grain[q];
  const Vec3 before = middle_of_path(work.grain_path(q), work.h);
  change_velocity(work.sand->position[grain.source], work.sand->velocity[grain.source], change, time);
  grain.since = time;
  grain.moved = raised(grain.moved + norm(middle_of_path(work.grain_path(q), work.h) - before));
}

/// Collision of two moving gas bodies at `time`; returns |J| times the distance of the centres, the pair's share of the
/// virial.
double collide(Work& work, Index i, Index j, double time) {
  if (work.id(j) < work.id(i)) std::swap(i, j);
  const Path a = work.path(i), b = work.path(j);
  const Vec3 closing = b.velocity - a.velocity;
  const Vec3 gap = nearest(work, b.start - a.start) + closing * time;
  const Vec3 n = line_of_centres(gap, closing);
  const double before = dot(closing, n), inverse_mass = 1.0 / work.mass, mu = 0.5 * work.mass;
  double after = -before;
  if (work.zeta > 0.0) {
    CounterRandom random = random_of_pair(work, work.id(i), work.id(j));
    double &e_a = work.gas->internal_energy[work.source(i)], &e_b = work.gas->internal_energy[work.source(j)];
    const EnergyExchange exchange = larsen_borgnakke(mu, before, e_a, e_b, work.zeta, random);
    after = exchange.normal_velocity, e_a = exchange.energy_i, e_b = exchange.energy_j;
  }
  const double impulse = pair_impulse(mu, before, after);
  const Vec3 change = n * (impulse * inverse_mass);
  deflect(work, i, -change, time);
  deflect(work, j, change, time);
  return impulse * norm(gap);
}

void touch(Work& work, Index p) {
  work.mark.touch(p, work.round);
  work.choice.forget(p);
  work.visit.push_back(p);
  const Path path = work.path(p);
  work.lanes.set(p, path.start, path.velocity * work.h);
  work.lanes.measure(path.start, path.velocity * work.h);
}

Due what_is_due(Work& work) {
  Due due;
  const auto consider = [&](Index p) {
    if (work.mark.taken(p, work.round)) return;
    const Choice choice = work.choice.of(p);
    switch (choice.kind) {
      case Hit::none:
        return;
      case Hit::gas: {
        const Choice back = work.choice.of(choice.partner);
        if (back.kind != Hit::gas || back.partner != p) return;
        due.pairs.push_back(p);
        work.mark.take(choice.partner, work.round);
        break;
      }
      case Hit::grain: {
        Grain& grain = work.grain[choice.partner];
        if (grain.chosen_in != work.round) {
          grain.chosen_in = static_cast<std::uint16_t>(work.round), grain.chosen_by = p;
          due.grains.push_back(choice.partner);
        } else if (std::tuple{choice.time, work.id(p)} <
                   std::tuple{work.choice.time(grain.chosen_by), work.id(grain.chosen_by)}) {
          grain.chosen_by = p;
        }
        break;
      }
      case Hit::unreleased:
        due.unreleased.push_back(p);
        break;
      case Hit::plane:
        due.planes.push_back(p);
        break;
      case Hit::sheet:
        due.sheet.push_back(p);
        break;
    }
    work.mark.take(p, work.round);
  };
  for (std::size_t k = 0; k < work.visitors(); ++k) consider(work.visitor(k));
  for (const Index p : work.offered) consider(p);
  return due;
}

void resolve_pairs(Work& work, const std::vector<Index>& pairs, GasCollideCounts& counts) {
#pragma omp parallel for num_threads(work.threads) schedule(static) if (pairs.size() > worth_threads)
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Choice choice = work.choice.of(pairs[k]);
    work.choice.leave(pairs[k], collide(work, pairs[k], choice.partner, choice.time));
  }
  for (const Index p : pairs) {
    const Index partner = work.choice.partner(p);
    counts.pair_virial += work.choice.time(p);
    touch(work, p);
    touch(work, partner);
  }
  counts.gas_hits += static_cast<long>(pairs.size());
}

void resolve_grains(Work& work, const std::vector<Index>& grains, GasCollideCounts& counts) {
  for (const Index q : grains) {
    const Index p = work.grain[q].chosen_by;
    const Path body = work.path(p), grain = work.grain_path(q);
    const double time = work.choice.time(p), inverse_mass = 1.0 / work.mass;
    const double inverse_grain = 1.0 / work.sand->mass_of(work.grain[q].source);
    const Vec3 closing = grain.velocity - body.velocity;
    const Vec3 n = line_of_centres(nearest(work, grain.start - body.start) + closing * time, closing);
    const double before = dot(closing, n);
    const double impulse = pair_impulse(reduced_mass(inverse_mass, inverse_grain), before, -before);
    deflect(work, p, n * (-impulse * inverse_mass), time);
    deflect_grain(work, q, n * (impulse * inverse_grain), time);
    touch(work, p);
    work.grain[q].touched_in = static_cast<std::uint16_t>(work.round);
    work.touched_grains.push_back(q);
    const Path now = work.grain_path(q);
    work.grain_lanes.set(q, now.start, now.velocity * work.h);
    work.grain_lanes.measure(now.start, now.velocity * work.h);
  }
  counts.sand_hits += static_cast<long>(grains.size());
}

void resolve_planes(Work& work, const std::vector<Index>& bodies, GasCollideCounts& counts) {
  for (const Index p : bodies) {
    const Choice choice = work.choice.of(p);
    const Vec3 change = change_at_plane(work.path(p).velocity, choice.partner);
    deflect(work, p, change, choice.time);
    counts.mirror_impulse -= change * work.mass;
    touch(work, p);
  }
  counts.mirror_hits += static_cast<long>(bodies.size());
}

void in_order_of_time(const Work& work, std::vector<Index>& bodies) {
  std::sort(bodies.begin(), bodies.end(), [&](Index p, Index q) {
    return std::tuple{work.choice.time(p), work.id(p)} < std::tuple{work.choice.time(q), work.id(q)};
  });
}

/// Bodies that meet unreleased gas: it answers as a cold particle at rest and keeps what it takes (kernels/
/// gas_release.hpp). In the order of time, because several may share a target and sums depend on their order.
void resolve_unreleased(Work& work, std::vector<Index>& bodies, GasCollideCounts& counts) {
  GasState& gas = *work.gas;
  in_order_of_time(work, bodies);
  for (const Index p : bodies) {
    const Choice choice = work.choice.of(p);
    const Index body = work.source(p), target = work.source(choice.partner);
    const Path path = work.path(p);
    const Vec3 gap = nearest(work, gas.position[target] - path.start) - path.velocity * choice.time;
    const Vec3 n = line_of_centres(gap, -path.velocity);
    CounterRandom random = random_of_pair(work, gas.id[body], gas.id[target]);
    const Absorbed taken =
        strike_waiting(work.mass, dot(path.velocity, n), gas.internal_energy[body], work.zeta, random);
    deflect(work, p, n * (-taken.impulse / work.mass), choice.time);
    gas.internal_energy[body] = taken.energy_left;
    gas.latent_impulse.add(gas.id[target], n * taken.impulse);
    gas.internal_energy[target] += taken.energy;
    touch(work, p);
  }
  counts.unreleased_hits += static_cast<long>(bodies.size());
}

/// Hits on the sheet one after the other. Each moves the sheet, so the next one is looked up again: the wall has
/// receded a little, the hit comes a little later; if it is gone, the body looks for another one.
template <bool Periodic>
void resolve_sheet(Work& work, std::vector<Index>& bodies, GasCollideCounts& counts) {
  in_order_of_time(work, bodies);
  for (const Index p : bodies) {
    const Path body = work.path(p);
    double time = no_impact;
    SheetPoint where;
    if (!first_hit_on_sheet<Periodic>(work, body, work.h, time, where)) {
      work.choice.forget(p);
      work.stale.push_back(p);
      continue;
    }
    Vec3 velocity = body.velocity;
    const Impact impact = work.sheet->collide(where, work.mass, 1.0, 0.0, time, velocity);
    deflect(work, p, velocity - body.velocity, time);
    work.gas->velocity[work.source(p)] = velocity;
    ++counts.sheet_hits;
    if (!where.rigid) {
      std::vector<double>& rebounds = work.gas->plate_rebound;
      if (rebounds.empty()) rebounds.assign(work.count(), std::numeric_limits<double>::quiet_NaN());
      double& rebound = rebounds[work.source(p)];
      if (std::isnan(rebound)) counts.plate_incoming -= work.mass * body.velocity.z;
      rebound = work.mass * velocity.z;
      counts.plate_impulse -= impact.impulse.z;
    }
    touch(work, p);
  }
}

}  // namespace

void resolve(Work& work, GasCollideCounts& counts) {
  Due due = what_is_due(work);
  work.visit.clear(), work.touched_grains.clear(), work.stale.clear();
  resolve_pairs(work, due.pairs, counts);
  resolve_grains(work, due.grains, counts);
  resolve_planes(work, due.planes, counts);
  resolve_unreleased(work, due.unreleased, counts);
  if (work.sheet == nullptr) return;
  work.periodic.on() ? resolve_sheet<true>(work, due.sheet, counts) : resolve_sheet<false>(work, due.sheet, counts);
}

}  // namespace standoff::particles::gas
