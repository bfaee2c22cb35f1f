#pragma once
// Working arrays of stage gas_collide for one sub-step, sorted by cell.
//
//   GasState --load--> body[p], choice[p]   p = place in cell order, body[p].source = index in GasState
//   SandState -load--> grain[q]             only the grains that gas can reach in this sub-step
//
// A body fills one cache line, because the search reads whole bodies of neighbouring cells one after the other.
// `binned` is where the grid believes a body to be: the middle of its path when the sub-step began. A path that lies
// within `excursion` of that point is found by asking for everything within contact distance + own half path +
// excursion.
#include <cstdint>
#include <limits>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/gas_impact_time.hpp"
#include "particle_solver/kernels/reflecting_planes.hpp"
#include "particle_solver/search/gas_cell_grid.hpp"
#include "particle_solver/search/gas_near_map.hpp"
#include "particle_solver/state/surface_sheet.hpp"
#include "particle_solver/step/gas_collide.hpp"
#include "particle_solver/step/gas_lanes.hpp"

namespace standoff::particles::gas {

using Index = std::uint32_t;
inline constexpr Index nobody = std::numeric_limits<Index>::max();

/// A gas particle on its present straight path, start + velocity * s for s in [since, h].
struct alignas(64) Body {
  Vec3 start;          // m, virtual: where the present path was at s = 0
  double since = 0.0;  // s, last hit of this sub-step; the path before it is not this one
  Vec3 velocity;       // m/s; zero while unreleased
  Index source = 0, id = 0;
};
static_assert(sizeof(Body) == 64);

struct Grain {
  Vec3 start;
  double since = 0.0;
  Vec3 velocity, binned;
  double radius = 0.0, inverse_mass = 0.0;
  Index source = 0;
  int touched_in = 0;        // round of the last hit, 0 = not hit
  Index chosen_by = nobody;  // earliest of the gas bodies that chose this grain in round `chosen_in`
  int chosen_in = 0;
};

/// The earliest hit on a body's path. Order of the kinds has no meaning.
enum class Hit : std::uint32_t { none, gas, unreleased, grain, plane, sheet };
struct Choice {
  double time = no_impact;  // s
  Index partner = nobody;   // body, grain or axis of the plane
  Hit kind = Hit::none;
};

struct Work {
  // of the sub-step
  double h = 0.0, radius = 0.0, mass = 0.0, zeta = 0.0;
  double periodic_side = 0.0;
  std::uint64_t seed = 0;
  std::uint32_t step = 0;
  int round = 0, threads = 1;
  ReflectingPlanes planes;
  SurfaceSheet* sheet = nullptr;

  // bodies, by place
  std::vector<Body> body;
  Lanes lanes;  // the paths again, for the search
  std::vector<Choice> choice;
  std::vector<Vec3> binned;
  std::vector<std::uint8_t> unreleased;  // empty once all are released
  std::vector<int> touched_in;           // round of the last hit, 0 = not hit
  std::vector<int> taken_in;             // round in which the body was put on a list of hits
  std::vector<std::uint8_t> pending;     // 1 while on waiting
  double excursion = 0.0;
  GasCellGrid grid;

  // grains, by place; empty when there is no sand near
  std::vector<Grain> grain;
  Lanes grain_lanes;
  double excursion_grain = 0.0, largest_grain = 0.0;  // m
  GasCellGrid grain_grid;

  // lists of places
  std::vector<Index> visit;           // bodies that look for their earliest hit in this round
  std::vector<Index> offered;         // bodies that were told of an earlier hit than they knew
  std::vector<Index> waiting;         // bodies with a choice that has not come true yet
  std::vector<Index> touched;         // bodies hit in this round
  std::vector<Index> touched_grains;  // grains hit in this round
  std::vector<Index> stale;           // bodies whose hit on the sheet was gone when its turn came

  // scratch of load
  std::vector<Vec3> middle;
  std::vector<Index> near_grain;
  GasNearMap near_map;

  bool is_unreleased(Index p) const { return !unreleased.empty() && unreleased[p] != 0; }
};

/// The separation of two centres, or of their nearest images in a periodic cube.
template <bool Periodic>
Vec3 nearest_image(Vec3 gap, double side) {
  if constexpr (Periodic) {
    const double inverse = 1.0 / side;
    gap.x -= side * nearest_whole(gap.x * inverse);
    gap.y -= side * nearest_whole(gap.y * inverse);
    gap.z -= side * nearest_whole(gap.z * inverse);
  }
  return gap;
}

/// Middle and half length of what is left of a path.
inline Vec3 middle_of_path(const Vec3& start, const Vec3& velocity, double since, double h) {
  return start + velocity * (0.5 * (since + h));
}
inline double half_path(const Vec3& velocity, double since, double h) {
  return 0.5 * (h - since) * norm(velocity);
}

/// gas_load.cpp: fills the work arrays, and writes the result back. `sort_state` also puts the state in cell order.
void load(Work& work, const GasState& gas, const SandState* sand);
void store(const Work& work, GasState& gas, SandState* sand, bool sort_state);

/// gas_search.cpp: earliest hits of the bodies in work.visit; then what the others must be told of. Returns how much
/// gas was looked at.
long search(Work& work);

/// gas_resolve.cpp: carries out the hits that are due, fills touched, touched_grains and stale.
void resolve(Work& work, GasState& gas, GasCollideCounts& counts);

/// gas_search.cpp: who looks again in the next round.
void choose_visitors(Work& work);

}  // namespace standoff::particles::gas
