#pragma once
// Carries the tangential springs of touching grains from one pair list to the next.
//
// A spring belongs to two grains, whatever their place in the lists. It is kept under the pair's smaller old index and
// found again by the other grain: exact, linear in the number of contacts, no limit on contacts per grain. What is not
// found (a grain was removed, or the pair flew apart within one step) is reported, so that its energy can be booked.
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "particle_solver/search/grain_pairs.hpp"

namespace standoff::particles {

/// A stretched tangential spring between two grains, by id; of the first against the second [m].
struct GrainSpring {
  std::uint32_t first_id = 0, second_id = 0;
  Vec3 spring;
};

class GrainHistory {
 public:
  /// Takes the stretched springs out of the lists of `count` grains; the lists forget them.
  void collect(std::vector<GrainBlock>& blocks, std::size_t count, int threads);
  /// Takes springs from a list by id, for a restart; `ids` are in sorted order.
  void collect(std::span<const GrainSpring> springs, std::span<const std::uint32_t> ids);
  bool empty() const { return parts_.empty(); }
  /// Puts them into new lists. `old_index` gives each grain's index at the time of `collect`, or `nobody`.
  void apply(std::vector<GrainBlock>& blocks, std::span<const std::uint32_t> old_index, int threads);
  /// Sum of the squares of the springs that `apply` found no place for [m2], and forgets everything.
  double finish();

  static constexpr std::uint32_t nobody = 0xFFFFFFFFu;

 private:
  struct Entry {
    std::uint32_t other = 0;
    bool found = false;
    Vec3 spring;
  };
  /// The springs of the old grains [begin, end), freed once the last of the new blocks that ask for them has done so:
  /// old and new springs are never all there at once.
  struct Part {
    std::uint32_t begin = 0, end = 0, first_entry = 0;
    std::vector<Entry> entries;
    std::atomic<int> asked_by = 0;
    std::vector<double> lost;  // m2, squares of springs that were not found
    Entry& at(std::uint32_t entry) { return entries[entry - first_entry]; }
    void close();
  };
  Part& open_part(std::size_t place, std::uint32_t begin, std::uint32_t end);
  std::size_t part_of(std::uint32_t old, std::size_t last) const;
  std::vector<std::size_t> parts_needed(const GrainBlock& block, std::span<const std::uint32_t> old_index) const;
  template <class Pair>
  void apply(PairList<Pair>& list, std::uint32_t begin, std::span<const std::uint32_t> old_index, bool mark);
  std::vector<std::uint32_t> start_;  // entries of old grain i: [start_[i], start_[i + 1])
  std::vector<Part> parts_;           // by old grains
};

/// All stretched springs by id, in the order of the lists, each once.
std::vector<GrainSpring> stretched_springs(const std::vector<GrainBlock>& blocks, std::span<const std::uint32_t> ids);

}  // namespace standoff::particles
