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

struct Pair {
  Index i, j;
  double time;
};

/// The hits of a round by what is hit.
struct Due {
  std::vector<Pair> pairs;
  std::vector<Index> grains, unreleased, planes,
      sheet;  // grains by place of the grain, the others by place of the body
};

Vec3 wrapped(const Work& work, Vec3 gap) {
  if (work.periodic_side <= 0.0) return gap;
  return nearest_image<true>(gap, work.periodic_side);
}

CounterRandom random_of_pair(const Work& work, Index id_a, Index id_b) {
  const std::uint64_t seed = work.seed + (static_cast<std::uint64_t>(work.round) << 32);
  return {seed, RandomUse::internal_energy, std::min(id_a, id_b), std::max(id_a, id_b), work.step};
}

/// Collision of two moving gas bodies at `time`; returns |J| times the distance of the centres, the pair's share of the
/// virial.
double collide(Work& work, GasState& gas, Index i, Index j, double time) {
  if (work.body[j].id < work.body[i].id) std::swap(i, j);
  Body &a = work.body[i], &b = work.body[j];
  const Vec3 closing = b.velocity - a.velocity;
  const Vec3 gap = wrapped(work, b.start - a.start) + closing * time;
  const Vec3 n = line_of_centres(gap, closing);
  const double before = dot(closing, n), inverse_mass = 1.0 / work.mass, mu = 0.5 * work.mass;
  double after = -before;
  if (work.zeta > 0.0) {
    CounterRandom random = random_of_pair(work, a.id, b.id);
    double &e_a = gas.internal_energy[a.source], &e_b = gas.internal_energy[b.source];
    const EnergyExchange exchange = larsen_borgnakke(mu, before, e_a, e_b, work.zeta, random);
    after = exchange.normal_velocity, e_a = exchange.energy_i, e_b = exchange.energy_j;
  }
  const double impulse = pair_impulse(mu, before, after);
  const Vec3 change = n * (impulse * inverse_mass);
  change_velocity(a.start, a.velocity, -change, time);
  change_velocity(b.start, b.velocity, change, time);
  a.since = b.since = time;
  return impulse * norm(gap);
}

void touch(Work& work, Index p) {
  work.touched_in[p] = work.round;
  work.choice[p] = {};
  work.touched.push_back(p);
  const Body& body = work.body[p];
  work.lanes.set(p, body.start, body.velocity, body.since);
}

Due what_is_due(Work& work) {
  Due due;
  const auto consider = [&](Index p) {
    const Choice& choice = work.choice[p];
    if (work.taken_in[p] == work.round) return;
    switch (choice.kind) {
      case Hit::none:
        return;
      case Hit::gas: {
        const Choice& back = work.choice[choice.partner];
        if (back.kind != Hit::gas || back.partner != p) return;
        due.pairs.push_back({p, choice.partner, choice.time});
        work.taken_in[choice.partner] = work.round;
        break;
      }
      case Hit::grain: {
        Grain& grain = work.grain[choice.partner];
        if (grain.chosen_in != work.round) {
          grain.chosen_in = work.round, grain.chosen_by = p;
          due.grains.push_back(choice.partner);
        } else if (std::tuple{choice.time, work.body[p].id} <
                   std::tuple{work.choice[grain.chosen_by].time, work.body[grain.chosen_by].id}) {
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
    work.taken_in[p] = work.round;
  };
  for (const Index p : work.visit) consider(p);
  for (const Index p : work.offered) consider(p);
  return due;
}

void resolve_pairs(Work& work, GasState& gas, const std::vector<Pair>& pairs, GasCollideCounts& counts) {
  std::vector<double> virial(pairs.size());
#pragma omp parallel for num_threads(work.threads) schedule(static) if (pairs.size() > worth_threads)
  for (std::size_t k = 0; k < pairs.size(); ++k) virial[k] = collide(work, gas, pairs[k].i, pairs[k].j, pairs[k].time);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    counts.pair_virial += virial[k];
    touch(work, pairs[k].i);
    touch(work, pairs[k].j);
  }
  counts.gas_hits += static_cast<long>(pairs.size());
}

void resolve_grains(Work& work, const std::vector<Index>& grains, GasCollideCounts& counts) {
  for (const Index q : grains) {
    Grain& grain = work.grain[q];
    const Index p = grain.chosen_by;
    Body& body = work.body[p];
    const double time = work.choice[p].time, inverse_mass = 1.0 / work.mass;
    const Vec3 closing = grain.velocity - body.velocity;
    const Vec3 n = line_of_centres(grain.start - body.start + closing * time, closing);
    const double before = dot(closing, n);
    const double impulse = pair_impulse(reduced_mass(inverse_mass, grain.inverse_mass), before, -before);
    change_velocity(body.start, body.velocity, n * (-impulse * inverse_mass), time);
    change_velocity(grain.start, grain.velocity, n * (impulse * grain.inverse_mass), time);
    body.since = grain.since = time;
    touch(work, p);
    grain.touched_in = work.round;
    work.touched_grains.push_back(q);
    work.grain_lanes.set(q, grain.start, grain.velocity, grain.since);
  }
  counts.sand_hits += static_cast<long>(grains.size());
}

void resolve_planes(Work& work, const std::vector<Index>& bodies, GasCollideCounts& counts) {
  for (const Index p : bodies) {
    Body& body = work.body[p];
    const double time = work.choice[p].time;
    const Vec3 change = change_at_plane(body.velocity, work.choice[p].partner);
    change_velocity(body.start, body.velocity, change, time);
    body.since = time;
    counts.mirror_impulse -= change * work.mass;
    touch(work, p);
  }
  counts.mirror_hits += static_cast<long>(bodies.size());
}

void in_order_of_time(const Work& work, std::vector<Index>& bodies) {
  std::sort(bodies.begin(), bodies.end(), [&](Index p, Index q) {
    return std::tuple{work.choice[p].time, work.body[p].id} < std::tuple{work.choice[q].time, work.body[q].id};
  });
}

/// Bodies that meet unreleased gas: it answers as a cold particle at rest and keeps what it takes (kernels/
/// gas_release.hpp). In the order of time, because several may share a target and sums depend on their order.
void resolve_unreleased(Work& work, GasState& gas, std::vector<Index>& bodies, GasCollideCounts& counts) {
  in_order_of_time(work, bodies);
  for (const Index p : bodies) {
    Body& body = work.body[p];
    const Body& target = work.body[work.choice[p].partner];
    const double time = work.choice[p].time;
    const Vec3 gap = wrapped(work, target.start - body.start) - body.velocity * time;
    const Vec3 n = line_of_centres(gap, -body.velocity);
    CounterRandom random = random_of_pair(work, body.id, target.id);
    const Absorbed taken =
        strike_waiting(work.mass, dot(body.velocity, n), gas.internal_energy[body.source], work.zeta, random);
    change_velocity(body.start, body.velocity, n * (-taken.impulse / work.mass), time);
    body.since = time;
    gas.internal_energy[body.source] = taken.energy_left;
    gas.latent_impulse[target.source] += n * taken.impulse;
    gas.internal_energy[target.source] += taken.energy;
    touch(work, p);
  }
  counts.unreleased_hits += static_cast<long>(bodies.size());
}

/// Hits on the sheet one after the other. Each moves the sheet, so the next one is looked up again: the wall has
/// receded a little, the hit comes a little later; if it is gone, the body looks for another one.
void resolve_sheet(Work& work, GasState& gas, std::vector<Index>& bodies, GasCollideCounts& counts) {
  in_order_of_time(work, bodies);
  for (const Index p : bodies) {
    Body& body = work.body[p];
    double time = no_impact;
    SheetPoint where;
    if (!work.sheet->first_hit(body.start, body.velocity, work.radius, body.since, work.h, time, where)) {
      work.choice[p] = {};
      work.stale.push_back(p);
      continue;
    }
    const Vec3 old = body.velocity;
    const Impact impact = work.sheet->collide(where, work.mass, 1.0, 0.0, time, body.velocity);
    body.start -= (body.velocity - old) * time;
    body.since = time;
    ++counts.sheet_hits;
    if (!where.rigid) {
      double& rebound = gas.plate_rebound[body.source];
      if (std::isnan(rebound)) counts.plate_incoming -= work.mass * old.z;
      rebound = work.mass * body.velocity.z;
      counts.plate_impulse -= impact.impulse.z;
    }
    touch(work, p);
  }
}

}  // namespace

void resolve(Work& work, GasState& gas, GasCollideCounts& counts) {
  work.touched.clear();
  work.touched_grains.clear();
  work.stale.clear();
  Due due = what_is_due(work);
  resolve_pairs(work, gas, due.pairs, counts);
  resolve_grains(work, due.grains, counts);
  resolve_planes(work, due.planes, counts);
  resolve_unreleased(work, gas, due.unreleased, counts);
  if (work.sheet != nullptr) resolve_sheet(work, gas, due.sheet, counts);
}

}  // namespace standoff::particles::gas
