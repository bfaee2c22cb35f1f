#pragma once
// Working arrays of stage gas_collide for one sub-step, in cell order. Paths themselves stay in GasState and SandState,
// which a hit changes at once; here is what a sub-step needs beside them, 55 bytes a body with its lanes.
//
//   p, place in cell order of a gas body; source(p) = index in GasState
//   q, place in cell order of a grain that gas can reach in this sub-step; grain[q].source = index in SandState
//
// The grid believes a body to be in the middle of its path when the sub-step began; `moved` bounds how far the middle
// of its present path is from there. A path that lies within `excursion` of that point is found by asking for
// everything within contact distance + own half path + excursion.
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/gas_impact_time.hpp"
#include "particle_solver/kernels/reflecting_planes.hpp"
#include "particle_solver/search/gas_cell_grid.hpp"
#include "particle_solver/search/gas_near_map.hpp"
#include "particle_solver/state/surface_sheet.hpp"
#include "particle_solver/step/gas_collide.hpp"
#include "particle_solver/step/gas_lanes.hpp"
#include "particle_solver/step/wrap.hpp"

namespace standoff::particles::gas {

using Index = std::uint32_t;
inline constexpr Index nobody = std::numeric_limits<Index>::max();

/// A straight path, start + velocity * s for s in [since, h].
struct Path {
  Vec3 start;          // m, virtual: where the present path was at s = 0
  Vec3 velocity;       // m/s; zero while unreleased
  double since = 0.0;  // s, last hit of this sub-step; the path before it is not this one
};

struct Grain {
  double since = 0.0;  // s
  Index source = 0;
  float moved = 0.0f;            // m
  Index chosen_by = nobody;      // earliest of the gas bodies that chose this grain in round `chosen_in`
  std::uint16_t chosen_in = 0;   // round
  std::uint16_t touched_in = 0;  // round of the last hit, 0 = not hit
};

/// The earliest hit on a body's path. Order of the kinds has no meaning.
enum class Hit : std::uint32_t { none, gas, unreleased, grain, plane, sheet };
struct Choice {
  double time = no_impact;  // s
  Index partner = 0;        // body, grain or axis of the plane
  Hit kind = Hit::none;
};

/// Choices of all bodies, kind and partner in one number.
class Choices {
 public:
  static constexpr unsigned partner_bits = 29;
  static constexpr Index most_partners = Index{1} << partner_bits;
  void reset(std::size_t count) { time_.assign(count, no_impact), what_.assign(count, 0); }
  Choice of(Index p) const {
    return {time_[p], what_[p] & (most_partners - 1), static_cast<Hit>(what_[p] >> partner_bits)};
  }
  Hit kind(Index p) const { return static_cast<Hit>(what_[p] >> partner_bits); }
  Index partner(Index p) const { return what_[p] & (most_partners - 1); }
  double time(Index p) const { return time_[p]; }
  void set(Index p, const Choice& choice) {
    time_[p] = choice.time, what_[p] = choice.partner | static_cast<Index>(choice.kind) << partner_bits;
  }
  void forget(Index p) { set(p, {}); }
  /// A number to keep in place of the time of a hit that is being carried out.
  void leave(Index p, double number) { time_[p] = number; }
  /// Room for one number a body, free until reset.
  std::span<Index> scratch(std::size_t count) {
    what_.resize(count);
    return what_;
  }
  /// The same of doubles, once no choice is needed any more.
  std::span<double> room() { return time_; }

 private:
  std::vector<double> time_;
  std::vector<Index> what_;
};

/// The rounds in which a body was last put on a list of hits and last hit, and whether it is on the list of waiting.
class Marks {
 public:
  static constexpr int most_rounds = 1000;
  void reset(std::size_t count) { mark_.assign(count, 0); }
  bool taken(Index p, int round) const { return (mark_[p] & ~pending) >= 2 * round; }
  void take(Index p, int round) { put(p, 2 * round); }
  bool touched(Index p, int round) const { return (mark_[p] & ~pending) == 2 * round + 1; }
  void touch(Index p, int round) { put(p, 2 * round + 1); }
  bool waits(Index p) const { return (mark_[p] & pending) != 0; }
  void wait(Index p) { mark_[p] = static_cast<std::uint16_t>(mark_[p] | pending); }
  void wait_no_more(Index p) { mark_[p] = static_cast<std::uint16_t>(mark_[p] & ~pending); }

 private:
  static constexpr int pending = 1 << 15;
  void put(Index p, int value) { mark_[p] = static_cast<std::uint16_t>((mark_[p] & pending) | value); }
  std::vector<std::uint16_t> mark_;
};

struct Work {
  // of the sub-step
  double h = 0.0, per_step = 0.0;  // s, 1/h
  double radius = 0.0, mass = 0.0, zeta = 0.0;
  PeriodicSides periodic;
  std::uint64_t seed = 0;
  std::uint32_t step = 0;
  int round = 0, threads = 1;
  ReflectingPlanes planes;
  SurfaceSheet* sheet = nullptr;
  GasState* gas = nullptr;
  SandState* sand = nullptr;

  // bodies, by place
  Lanes lanes;  // the paths again, for the search
  std::vector<double> since;
  Choices choice;
  Marks mark;
  std::vector<float> moved;  // m
  double excursion = 0.0;    // m
  GasCellGrid grid;

  // grains, by place; empty when there is no sand near
  std::vector<Grain> grain;
  Lanes grain_lanes;
  double excursion_grain = 0.0, largest_grain = 0.0;  // m
  GasCellGrid grain_grid;

  // lists of places
  std::vector<Index> visit;           // bodies that look for their earliest hit in this round; in the first all do
  std::vector<Index> offered;         // bodies that were told of an earlier hit than they knew
  std::vector<Index> waiting;         // bodies with a choice that has not come true yet
  std::vector<Index> touched_grains;  // grains hit in this round
  std::vector<Index> stale;           // bodies whose hit on the sheet was gone when its turn came
  GasNearMap near_map;

  std::size_t count() const { return since.size(); }
  Index source(Index p) const { return grid.order()[p]; }
  Index id(Index p) const { return gas->id[source(p)]; }
  bool is_unreleased(Index p) const { return !gas->released.empty() && gas->released[source(p)] == 0; }
  Path path(Index p) const {
    const Index i = source(p);
    return {gas->position[i], is_unreleased(p) ? Vec3{} : gas->velocity[i], since[p]};
  }
  Path grain_path(Index q) const {
    const Index i = grain[q].source;
    return {sand->position[i], sand->velocity[i], grain[q].since};
  }
  double grain_radius(Index q) const { return sand->radius_of(grain[q].source); }
  /// How many look in this round, and the k-th of them; in the first also those that cannot move.
  std::size_t visitors() const { return round == 1 ? count() : visit.size(); }
  Index visitor(std::size_t k) const { return round == 1 ? static_cast<Index>(k) : visit[k]; }
};

/// First hit of a body on the sheet until `until`; false if there is none.
template <bool Periodic>
bool first_hit_on_sheet(const Work& work, const Path& path, double until, double& time, SheetPoint& where) {
  if constexpr (Periodic)
    return first_hit_on_the_way(work.periodic, *work.sheet, path.start, path.velocity, work.radius, path.since, until,
                                time, where);
  return work.sheet->first_hit(path.start, path.velocity, work.radius, path.since, until, time, where);
}

/// Middle and half length of what is left of a path.
inline Vec3 middle_of_path(const Path& path, double h) {
  return path.start + path.velocity * (0.5 * (path.since + h));
}
inline double half_path(const Path& path, double h) {
  return 0.5 * (h - path.since) * norm(path.velocity);
}

/// gas_load.cpp: fills the work arrays; puts the state in cell order.
void load(Work& work);
void sort_state(Work& work);

/// gas_search.cpp: earliest hits of the visitors; then what the others must be told of. Returns how many looked and at
/// how much gas.
struct Looked {
  long searches = 0, candidates = 0;
};
Looked search(Work& work);

/// gas_resolve.cpp: carries out the hits that are due; leaves those who were hit in work.visit, fills touched_grains
/// and stale.
void resolve(Work& work, GasCollideCounts& counts);

/// gas_search.cpp: who looks again in the next round.
void choose_visitors(Work& work);

}  // namespace standoff::particles::gas
