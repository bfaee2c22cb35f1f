#pragma once
// Candidate pairs of grains, each once, in blocks that can be worked on independently.
//
// The sorted grains are cut into blocks of whole bricks; the cut depends on the number of grains only, never on
// threads.
//
//   block b owns grains [begin, end)      inner: both grains in b, i < j, listed once; the force goes to both
//                                         rim:   j in another block; listed by both blocks, the force goes to i only
//
// A rim pair is worked out twice, once from each side, with exactly opposite results: no block writes another's grain,
// so no atomics, no colours, and the same bits for any number of threads. With 2000 grains a block that is 4 % more
// work.
//
// DATA LAYOUT: pairs in groups of four (one SIMD pack). At least one slot at the end is filled with the pair (begin,
// far away), which never touches. With friction the pairs that touch have a spring: kept apart, in the order of their
// slots, since only one listed pair in three touches; each group has a bit per slot, 0 = no spring.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "particle_solver/kernels/grain_lanes.hpp"
#include "particle_solver/search/grain_cells.hpp"

namespace standoff::particles {

struct GrainPair {
  std::uint32_t i = 0, j = 0;  // sorted indices
};

/// Ends a list of springs; without friction the list has not even this.
inline constexpr GrainRecord no_spring{0.0, 0.0, 0.0, -1.0};

struct PairList {
  std::vector<GrainPair> pairs;         // a multiple of four, more than `count`
  std::size_t count = 0;                // without the filling
  std::vector<GrainRecord> springs;     // m, tangential, of i against j; w is the slot; ends with no_spring
  std::vector<std::uint8_t> stretched;  // a bit per slot
  std::size_t groups() const { return pairs.size() / 4; }
};

struct GrainBlock {
  std::uint32_t begin = 0, end = 0;             // grains
  std::size_t first_brick = 0, last_brick = 0;  // bricks [first, last)
  PairList inner, rim;
};

struct PairListOptions {
  double cutoff = 0.0;   // m, largest centre distance that is listed
  double skin = 0.0;     // m, with radii: listed up to r_i + r_j + skin
  bool radii = false;    // grains differ: the radius is in GrainRecord::w
  bool springs = false;  // friction: make room for tangential springs
  const Vec3* box = nullptr;
  int threads = 1;
};

/// Cuts and lists. `grains` are in sorted order, with one record more far away from all (the filling). `blocks` is
/// reused.
void list_grain_pairs(const GrainCells& cells, std::span<const GrainRecord> grains, const PairListOptions& options,
                      std::vector<GrainBlock>& blocks);

}  // namespace standoff::particles
