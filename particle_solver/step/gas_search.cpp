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

/// Calls look(k) with every body of [begin, end) that the probe may meet.
template <Partner Kind, bool Periodic, class Look>
[[gnu::always_inline]] inline void look_in_run(const Lanes& lanes, Index begin, Index end, const Probe& probe,
                                               Look&& look) {
  for (Index q = begin; q < end; q += 8)
    for (unsigned hits = hit_in_time<Kind, Periodic>(lanes, q, probe); hits != 0; hits &= hits - 1)
      if (const Index k = q + static_cast<Index>(std::countr_zero(hits)); k < end) look(k);
}

template <bool Periodic>
[[gnu::always_inline]] inline Probe probe_of(const Work& work, const Lanes& lanes, const Path& path, double until,
                                             double contact) {
  const double per_step = work.per_step;
  Probe probe(lanes, path.start, path.velocity * work.h, path.since * per_step, until * per_step, contact);
  if constexpr (Periodic) probe.repeat(work.periodic.period);
  return probe;
}

/// Earliest hit of body p on other gas; returns how many bodies were looked at.
template <bool Periodic>
long look_at_gas(Work& work, Index p) {
  const Path me = work.path(p);
  const double contact = 2.0 * work.radius;
  Probe probe = probe_of<Periodic>(work, work.lanes, me, work.h, contact);
  double until = work.h;
  Index partner = nobody;
  long looked_at = 0;
  const auto look = [&](Index q) {
    if (q == p) return;
    const Path other = work.path(q);
    const Vec3 gap = nearest_image<Periodic>(other.start - me.start, work.periodic.period);
    const double time = impact_time(gap, other.velocity - me.velocity, contact, std::max(me.since, other.since), until);
    if (time > until) return;
    if (partner != nobody && !earlier_pair(time, work.id(p), work.id(q), until, work.id(partner))) return;
    until = time, partner = q;
    probe.narrow(until * work.per_step);
  };
  const double reach = contact + half_path(me, work.h) + work.excursion;
  work.grid.visit<Periodic>(middle_of_path(me, work.h), reach, [&](Index begin, Index end) {
    looked_at += end - begin;
    look_in_run<Partner::gas, Periodic>(work.lanes, begin, end, probe, look);
  });
  if (partner != nobody) work.choice.set(p, {until, partner, work.is_unreleased(partner) ? Hit::unreleased : Hit::gas});
  return looked_at;
}

template <bool Periodic>
void look_at_grains(Work& work, Index p) {
  const Path me = work.path(p);
  Choice choice = work.choice.of(p);
  double until = std::min(choice.time, work.h);
  Probe probe = probe_of<Periodic>(work, work.grain_lanes, me, until, work.radius + work.largest_grain);
  const auto look = [&](Index q) {
    const Path grain = work.grain_path(q);
    const Vec3 gap = nearest_image<Periodic>(grain.start - me.start, work.periodic.period);
    const double time = impact_time(gap, grain.velocity - me.velocity, work.radius + work.grain_radius(q),
                                    std::max(me.since, grain.since), until);
    if (!(time < choice.time)) return;
    until = time;
    choice = {time, q, Hit::grain};
    probe.narrow(until * work.per_step);
  };
  const double reach = work.radius + work.largest_grain + half_path(me, work.h) + work.excursion_grain;
  work.grain_grid.visit<Periodic>(middle_of_path(me, work.h), reach, [&](Index begin, Index end) {
    look_in_run<Partner::grain, Periodic>(work.grain_lanes, begin, end, probe, look);
  });
  if (choice.kind == Hit::grain) work.choice.set(p, choice);
}

/// The centre is mirrored at the plane itself, not one radius before it: a layer without gas there is no part of the
/// symmetric scene. The plane lacks the partners beyond it, which thin gas does not notice; dense gas is then denser
/// within a diameter of the plane, as at any wall, and as if the plane stood 3 f r / (1 + 2 f) nearer (f fill, r
/// radius; scaled particle theory, Reiss, Frisch, Helfand & Lebowitz, J. Chem. Phys. 32 (1960) 119).
void look_at_planes(Work& work, Index p) {
  const Path me = work.path(p);
  const PlaneHit hit = first_plane(work.planes, me.start, me.velocity, me.since, work.h);
  if (hit.time < work.choice.time(p)) work.choice.set(p, {hit.time, hit.axis, Hit::plane});
}

template <bool Periodic>
void look_at_sheet(Work& work, Index p, double highest) {
  const Path me = work.path(p);
  const double lowest = me.start.z + std::min(me.velocity.z * me.since, me.velocity.z * work.h) - work.radius;
  if (lowest > highest) return;
  const double known = work.choice.time(p), until = std::min(known, work.h);
  double time = no_impact;
  SheetPoint where;
  if (first_hit_on_sheet<Periodic>(work, me, until, time, where) && time < known)
    work.choice.set(p, {time, 0, Hit::sheet});
}

/// A hit that one body knows of and the other does not: the other did not look in this round.
void offer(Work& work, Index p, Index partner, double time) {
  const Choice known = work.choice.of(partner);
  const bool gas_known = known.kind == Hit::gas || known.kind == Hit::unreleased;
  if (known.kind == Hit::gas && known.partner == p && known.time == time) return;
  const bool earlier = gas_known ? earlier_pair(time, work.id(partner), work.id(p), known.time, work.id(known.partner))
                                 : time < known.time;
  if (!earlier) return;
  work.choice.set(partner, {time, p, Hit::gas});
  work.offered.push_back(partner);
}

/// Grains look for gas only after they were hit: until then the gas has seen them. Unreleased gas is no partner of a
/// grain.
template <bool Periodic>
void look_from_grain(Work& work, Index q) {
  const Path grain = work.grain_path(q);
  const double contact = work.radius + work.grain_radius(q);
  double best = work.h;
  Index partner = nobody;
  Probe probe = probe_of<Periodic>(work, work.lanes, grain, best, contact);
  const auto look = [&](Index p) {
    const Path body = work.path(p);
    const Vec3 gap = nearest_image<Periodic>(body.start - grain.start, work.periodic.period);
    const double time =
        impact_time(gap, body.velocity - grain.velocity, contact, std::max(grain.since, body.since), best);
    if (!(time <= best) || work.is_unreleased(p)) return;
    if (time == best && partner != nobody && work.id(partner) < work.id(p)) return;
    best = time, partner = p;
    probe.narrow(best * work.per_step);
  };
  const double reach = contact + half_path(grain, work.h) + work.excursion;
  work.grid.visit<Periodic>(middle_of_path(grain, work.h), reach, [&](Index begin, Index end) {
    look_in_run<Partner::gas, Periodic>(work.lanes, begin, end, probe, look);
  });
  if (partner == nobody || !(best < work.choice.time(partner))) return;
  work.choice.set(partner, {best, q, Hit::grain});
  work.offered.push_back(partner);
}

/// Every visitor looks at all that the scene holds, in one parallel pass.
template <bool Periodic>
Looked look_around(Work& work) {
  const bool grains = !work.grain.empty(), planes = work.planes.on, sheet = work.sheet != nullptr;
  const double highest = sheet ? work.sheet->highest(work.h) : 0.0;
  const std::size_t count = work.visitors();
  long searches = 0, looked_at = 0;
#pragma omp parallel for num_threads(work.threads) schedule(dynamic, 128) reduction(+ : searches, looked_at) if (count > worth_threads)
  for (std::size_t k = 0; k < count; ++k) {
    const Index p = work.visitor(k);
    if (work.round == 1 && work.is_unreleased(p)) continue;
    ++searches;
    work.choice.forget(p);
    looked_at += look_at_gas<Periodic>(work, p);
    if (grains) look_at_grains<Periodic>(work, p);
    if (planes) look_at_planes(work, p);
    if (sheet) look_at_sheet<Periodic>(work, p, highest);
  }
  return {searches, looked_at};
}

void keep_waiting(Work& work, Index p) {
  if (work.choice.kind(p) == Hit::none || work.mark.waits(p)) return;
  work.mark.wait(p);
  work.waiting.push_back(p);
}

template <bool Periodic>
Looked search_images(Work& work) {
  const Looked looked = look_around<Periodic>(work);
  work.offered.clear();
  if (work.round > 1) {  // in the first round everybody has looked
    for (const Index p : work.visit)
      if (const Choice choice = work.choice.of(p); choice.kind == Hit::gas) offer(work, p, choice.partner, choice.time);
    for (const Index q : work.touched_grains) look_from_grain<Periodic>(work, q);
  }
  for (std::size_t k = 0; k < work.visitors(); ++k) keep_waiting(work, work.visitor(k));
  for (const Index p : work.offered) keep_waiting(work, p);
  return looked;
}

}  // namespace

Looked search(Work& work) {
  return work.periodic.on() ? search_images<true>(work) : search_images<false>(work);
}

void choose_visitors(Work& work) {
  for (const Index p : work.visit)
    work.excursion = std::max(work.excursion, half_path(work.path(p), work.h) + static_cast<double>(work.moved[p]));
  for (const Index q : work.touched_grains)
    work.excursion_grain = std::max(work.excursion_grain,
                                    half_path(work.grain_path(q), work.h) + static_cast<double>(work.grain[q].moved));
  for (const Index p : work.stale) work.visit.push_back(p);

  std::size_t left = 0;
  for (const Index p : work.waiting) {
    const Choice choice = work.choice.of(p);
    if (choice.kind == Hit::none) {
      work.mark.wait_no_more(p);
      continue;
    }
    work.waiting[left++] = p;
    const bool partner_touched =
        (choice.kind == Hit::grain && work.grain[choice.partner].touched_in == work.round) ||
        ((choice.kind == Hit::gas || choice.kind == Hit::unreleased) && work.mark.touched(choice.partner, work.round));
    if (partner_touched) work.visit.push_back(p);
  }
  work.waiting.resize(left);
}

}  // namespace standoff::particles::gas
