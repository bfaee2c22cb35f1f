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
// DATA LAYOUT: pairs in groups of four (one SIMD pack), with at least one slot at the end that is filled and means
// nothing. An inner pair takes four bytes, since a block is small; one that does not fit is listed as two rim pairs.
// With friction the pairs that touch have a spring: three numbers kept apart, in the order of their slots, since only
// one listed pair in three touches; each group has a bit per slot, 0 = no spring. Lists own no spare room.
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "particle_solver/kernels/grain_lanes.hpp"
#include "particle_solver/search/grain_cells.hpp"

namespace standoff::particles {

struct GrainPair {
  std::uint32_t i = 0, j = 0;  // sorted indices
};

/// The same from the first grain of a block on.
struct NearPair {
  std::uint16_t i = 0, j = 0;
};

inline GrainPair whole_pair(GrainPair pair, std::uint32_t) {
  return pair;
}
inline GrainPair whole_pair(NearPair pair, std::uint32_t begin) {
  return {begin + pair.i, begin + pair.j};
}

template <class Pair>
struct PairList {
  std::vector<Pair> pairs;      // a multiple of four, more than `count`
  std::size_t count = 0;        // without the filling
  std::vector<double> springs;  // m, tangential, of i against j: x, y, z of each, and one number more at the end
  std::vector<std::uint8_t> stretched;  // a bit per slot
  std::size_t groups() const { return pairs.size() / 4; }
  /// Calls visit(slot, spring) in the order of the slots.
  template <class Visit>
  void for_each_spring(Visit&& visit) const {
    const double* next = springs.data();
    for (std::size_t group = 0; group < stretched.size(); ++group)
      for (unsigned bits = stretched[group]; bits != 0; bits &= bits - 1, next += 3)
        visit(4 * group + static_cast<unsigned>(std::countr_zero(bits)), next);
  }
};

struct GrainBlock {
  std::uint32_t begin = 0, end = 0;             // grains
  std::size_t first_brick = 0, last_brick = 0;  // bricks [first, last)
  PairList<NearPair> inner;
  PairList<GrainPair> rim;

  /// Calls visit(pair) with every pair.
  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    const auto in_list = [&](const auto& list) {
      for (std::size_t p = 0; p < list.count; ++p) visit(whole_pair(list.pairs[p], begin));
    };
    in_list(inner), in_list(rim);
  }
  /// Calls visit(pair, spring) with every pair that has a spring.
  template <class Visit>
  void for_each_spring(Visit&& visit) const {
    const auto in_list = [&](const auto& list) {
      list.for_each_spring([&](std::size_t slot, const double* spring) {
        visit(whole_pair(list.pairs[slot], begin), Vec3{spring[0], spring[1], spring[2]});
      });
    };
    in_list(inner), in_list(rim);
  }
};

struct PairListOptions {
  double cutoff = 0.0;        // m, largest centre distance that is listed
  double skin = 0.0;          // m, with radii: listed up to r_i + r_j + skin
  bool radii = false;         // grains differ: the radius is in GrainRecord::w
  bool springs = false;       // friction: make room for tangential springs
  const Vec3* box = nullptr;  // m, lengths of a periodic box, 0 along an axis: open there
  Vec3 per_box;               // 1/m, 0 likewise
  int threads = 1;
  std::uint32_t longest_offset = 0xFFFF;  // of an inner pair from the start of its block; a test asks for less
};

/// Cuts and lists. `grains` are in sorted order, with one record more far away from all (the filling). `blocks` is
/// reused.
void list_grain_pairs(const GrainCells& cells, std::span<const GrainRecord> grains, const PairListOptions& options,
                      std::vector<GrainBlock>& blocks);

}  // namespace standoff::particles
