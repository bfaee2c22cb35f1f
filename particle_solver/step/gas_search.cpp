// Earliest hits. Each pass looks at one kind of partner and only ever writes the choice of the body it searches for, so
// the passes run in parallel and give the same bits for any number of threads.
#include <algorithm>
#include <bit>
#include <tuple>

#include "particle_solver/step/gas_work.hpp"

namespace standoff::particles::gas {
namespace {

// Fewer visitors than this are searched by one thread: waking the others costs more (tens of microseconds). No effect
// on bits.
constexpr std::size_t worth_threads = 1000;

/// Order of two possible hits of one body on gas: by time, ties by the ids of the pair. The same pair compares the same
/// from either side, so a ring of simultaneous hits always has a first pair, and the rounds cannot lock.
bool earlier_pair(double time, Index id, Index other, double than_time, Index than_other) {
  if (time != than_time) return time < than_time;
  return std::tuple{std::min(id, other), std::max(id, other)} <
         std::tuple{std::min(id, than_other), std::max(id, than_other)};
}

/// Earliest hit of body p on other gas; returns how many bodies were looked at.
template <bool Periodic>
long look_at_gas(Work& work, Index p) {
  constexpr Partner kind = Periodic ? Partner::gas_in_periodic_cube : Partner::gas;
  const Body& me = work.body[p];
  Probe probe{me.start, me.velocity, me.since, 2.0 * work.radius, work.h, work.periodic_side};
  Index partner = nobody;
  long looked_at = 0;
  const auto look = [&](Index q) {
    const Body& other = work.body[q];
    const Vec3 gap = nearest_image<Periodic>(other.start - me.start, work.periodic_side);
    const double time =
        impact_time(gap, other.velocity - me.velocity, probe.contact, std::max(me.since, other.since), probe.until);
    if (time > probe.until) return;
    if (partner != nobody && !earlier_pair(time, me.id, other.id, probe.until, work.body[partner].id)) return;
    probe.until = time, partner = q;
  };
  const double reach = probe.contact + half_path(me.velocity, me.since, work.h) + work.excursion;
  work.grid.visit<Periodic>(
      middle_of_path(me.start, me.velocity, me.since, work.h), reach, [&](Index begin, Index end) {
        looked_at += end - begin;
        for (Index q = begin; q < end; q += 4)
          for (int hits = hit_in_time<kind>(work.lanes, q, probe); hits != 0; hits &= hits - 1)
            if (const Index k = q + static_cast<Index>(std::countr_zero(static_cast<unsigned>(hits))); k < end) look(k);
      });
  if (partner != nobody)
    work.choice[p] = {probe.until, partner, work.is_unreleased(partner) ? Hit::unreleased : Hit::gas};
  return looked_at;
}

void look_at_grains(Work& work, Index p) {
  const Body& me = work.body[p];
  Choice& choice = work.choice[p];
  Probe probe{me.start, me.velocity, me.since, 0.0, std::min(choice.time, work.h), 0.0};
  const auto look = [&](Index q) {
    const Grain& grain = work.grain[q];
    const double time = impact_time(grain.start - me.start, grain.velocity - me.velocity, work.radius + grain.radius,
                                    std::max(me.since, grain.since), probe.until);
    if (!(time < choice.time)) return;
    probe.until = time;
    choice = {time, q, Hit::grain};
  };
  const double reach =
      work.radius + work.largest_grain + half_path(me.velocity, me.since, work.h) + work.excursion_grain;
  work.grain_grid.visit<false>(
      middle_of_path(me.start, me.velocity, me.since, work.h), reach, [&](Index begin, Index end) {
        for (Index q = begin; q < end; q += 4)
          for (int hits = hit_in_time<Partner::grain>(work.grain_lanes, q, probe); hits != 0; hits &= hits - 1)
            if (const Index k = q + static_cast<Index>(std::countr_zero(static_cast<unsigned>(hits))); k < end) look(k);
      });
}

/// The centre is mirrored at the plane itself, not one radius before it: a layer without gas there is no part of the
/// symmetric scene. The plane lacks the partners beyond it, which thin gas does not notice; dense gas is then denser
/// within a diameter of the plane, as at any wall, and as if the plane stood 3 f r / (1 + 2 f) nearer (f fill, r
/// radius; scaled particle theory, Reiss, Frisch, Helfand & Lebowitz, J. Chem. Phys. 32 (1960) 119).
void look_at_planes(Work& work, Index p) {
  const Body& me = work.body[p];
  const PlaneHit hit = first_plane(work.planes, me.start, me.velocity, me.since, work.h);
  if (hit.time < work.choice[p].time) work.choice[p] = {hit.time, hit.axis, Hit::plane};
}

void look_at_sheet(Work& work, Index p, double highest) {
  const Body& me = work.body[p];
  const double lowest = me.start.z + std::min(me.velocity.z * me.since, me.velocity.z * work.h) - work.radius;
  if (lowest > highest) return;
  Choice& choice = work.choice[p];
  const double until = std::min(choice.time, work.h);
  double time = no_impact;
  SheetPoint where;
  if (work.sheet->first_hit(me.start, me.velocity, work.radius, me.since, until, time, where) && time < choice.time)
    choice = {time, nobody, Hit::sheet};
}

/// A hit that one body knows of and the other does not: the other did not look in this round.
void offer(Work& work, Index p, Index partner, double time) {
  Choice& known = work.choice[partner];
  const bool gas_known = known.kind == Hit::gas || known.kind == Hit::unreleased;
  if (known.kind == Hit::gas && known.partner == p && known.time == time) return;
  const bool earlier =
      gas_known ? earlier_pair(time, work.body[partner].id, work.body[p].id, known.time, work.body[known.partner].id)
                : time < known.time;
  if (!earlier) return;
  known = {time, p, Hit::gas};
  work.offered.push_back(partner);
}

/// Grains look for gas only after they were hit: until then the gas has seen them. Unreleased gas is no partner of a
/// grain.
void look_from_grain(Work& work, Index q) {
  const Grain& grain = work.grain[q];
  const double reach = work.radius + grain.radius + half_path(grain.velocity, grain.since, work.h) + work.excursion;
  double best = work.h;
  Index partner = nobody;
  work.grid.visit<false>(
      middle_of_path(grain.start, grain.velocity, grain.since, work.h), reach, [&](Index begin, Index end) {
        for (Index p = begin; p < end; ++p) {
          const Body& body = work.body[p];
          const double time = impact_time(body.start - grain.start, body.velocity - grain.velocity,
                                          work.radius + grain.radius, std::max(grain.since, body.since), best);
          if (!(time <= best) || work.is_unreleased(p)) continue;
          if (time == best && partner != nobody && work.body[partner].id < body.id) continue;
          best = time, partner = p;
        }
      });
  if (partner == nobody || !(best < work.choice[partner].time)) return;
  work.choice[partner] = {best, q, Hit::grain};
  work.offered.push_back(partner);
}

/// Every visitor looks at all that the scene holds, in one parallel pass.
template <bool Periodic>
long look_around(Work& work) {
  const bool grains = !work.grain.empty(), planes = work.planes.on, sheet = work.sheet != nullptr;
  const double highest = sheet ? work.sheet->highest(work.h) : 0.0;
  const std::size_t count = work.visit.size();
  long looked_at = 0;
#pragma omp parallel for num_threads(work.threads) schedule(dynamic, 128) reduction(+ : looked_at) if (count > worth_threads)
  for (std::size_t k = 0; k < count; ++k) {
    const Index p = work.visit[k];
    work.choice[p] = {};
    looked_at += look_at_gas<Periodic>(work, p);
    if (grains) look_at_grains(work, p);
    if (planes) look_at_planes(work, p);
    if (sheet) look_at_sheet(work, p, highest);
  }
  return looked_at;
}

void keep_waiting(Work& work, Index p) {
  if (work.choice[p].kind == Hit::none || work.pending[p] != 0) return;
  work.pending[p] = 1;
  work.waiting.push_back(p);
}

}  // namespace

long search(Work& work) {
  const long looked_at = work.periodic_side > 0.0 ? look_around<true>(work) : look_around<false>(work);
  work.offered.clear();
  if (work.round > 1) {  // in the first round everybody has looked
    for (const Index p : work.visit)
      if (work.choice[p].kind == Hit::gas) offer(work, p, work.choice[p].partner, work.choice[p].time);
    for (const Index q : work.touched_grains) look_from_grain(work, q);
  }
  for (const Index p : work.visit) keep_waiting(work, p);
  for (const Index p : work.offered) keep_waiting(work, p);
  return looked_at;
}

void choose_visitors(Work& work) {
  work.visit.clear();
  for (const Index p : work.touched) {
    work.visit.push_back(p);
    const Body& body = work.body[p];
    const double half = half_path(body.velocity, body.since, work.h);
    const double moved = norm(middle_of_path(body.start, body.velocity, body.since, work.h) - work.binned[p]);
    work.excursion = std::max(work.excursion, half + moved);
  }
  for (const Index q : work.touched_grains) {
    const Grain& grain = work.grain[q];
    const double half = half_path(grain.velocity, grain.since, work.h);
    const double moved = norm(middle_of_path(grain.start, grain.velocity, grain.since, work.h) - grain.binned);
    work.excursion_grain = std::max(work.excursion_grain, half + moved);
  }
  for (const Index p : work.stale) work.visit.push_back(p);

  std::size_t left = 0;
  for (const Index p : work.waiting) {
    const Choice& choice = work.choice[p];
    if (choice.kind == Hit::none) {
      work.pending[p] = 0;
      continue;
    }
    work.waiting[left++] = p;
    const bool partner_touched =
        (choice.kind == Hit::grain && work.grain[choice.partner].touched_in == work.round) ||
        ((choice.kind == Hit::gas || choice.kind == Hit::unreleased) && work.touched_in[choice.partner] == work.round);
    if (partner_touched) work.visit.push_back(p);
  }
  work.waiting.resize(left);
}

}  // namespace standoff::particles::gas
