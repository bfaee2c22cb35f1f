#include "particle_solver/search/grain_history.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace standoff::particles {

namespace {

/// Calls visit(i, j, spring) for every stretched spring of a block, each contact once, as i against j with i < j.
template <class Visit>
void for_each_spring(const GrainBlock& block, Visit&& visit) {
  block.for_each_spring([&](GrainPair pair, const Vec3& spring) {
    if (pair.i < pair.j && squared_norm(spring) > 0.0) visit(pair.i, pair.j, spring);
  });
}

}  // namespace

void GrainHistory::collect(std::vector<GrainBlock>& blocks, std::size_t count, int threads) {
  // Each block writes the counts and entries of its own grains only.
  const auto blocks_count = static_cast<int>(blocks.size());
  start_.assign(count + 1, 0);
  parts_ = std::vector<Part>(blocks.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int b = 0; b < blocks_count; ++b)
    for_each_spring(blocks[static_cast<std::size_t>(b)],
                    [&](std::uint32_t i, std::uint32_t, const Vec3&) { ++start_[i + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int b = 0; b < blocks_count; ++b) {
    GrainBlock& block = blocks[static_cast<std::size_t>(b)];
    Part& part = open_part(static_cast<std::size_t>(b), block.begin, block.end);
    for_each_spring(block, [&](std::uint32_t i, std::uint32_t j, const Vec3& spring) {
      part.at(next[i]++) = {j, false, spring};
    });
    block.inner = {}, block.rim = {};
  }
}

void GrainHistory::collect(std::span<const GrainSpring> springs, std::span<const std::uint32_t> ids) {
  std::unordered_map<std::uint32_t, std::uint32_t> index_of;
  for (std::size_t i = 0; i < ids.size(); ++i) index_of[ids[i]] = static_cast<std::uint32_t>(i);
  std::vector<std::uint32_t> keys;
  std::vector<Entry> found;
  for (const GrainSpring& s : springs) {
    const std::uint32_t a = index_of.at(s.first_id), b = index_of.at(s.second_id);
    keys.push_back(std::min(a, b));
    found.push_back({std::max(a, b), false, a < b ? s.spring : -s.spring});
  }
  start_.assign(ids.size() + 1, 0);
  for (const std::uint32_t key : keys) ++start_[key + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  parts_ = std::vector<Part>(1);
  Part& part = open_part(0, 0, static_cast<std::uint32_t>(ids.size()));
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t e = 0; e < keys.size(); ++e) part.at(next[keys[e]]++) = found[e];
}

GrainHistory::Part& GrainHistory::open_part(std::size_t place, std::uint32_t begin, std::uint32_t end) {
  Part& part = parts_[place];
  part.begin = begin, part.end = end, part.first_entry = start_[begin];
  part.entries.resize(start_[end] - start_[begin]);
  return part;
}

/// The part that holds an old grain; neighbours ask for the same one again and again.
std::size_t GrainHistory::part_of(std::uint32_t old, std::size_t last) const {
  if (old >= parts_[last].begin && old < parts_[last].end) return last;
  const auto after = std::upper_bound(parts_.begin(), parts_.end(), old,
                                      [](std::uint32_t grain, const Part& part) { return grain < part.begin; });
  return static_cast<std::size_t>(after - parts_.begin()) - 1;
}

/// The parts that a new block will ask: those of its grains and of their partners in other blocks.
std::vector<std::size_t> GrainHistory::parts_needed(const GrainBlock& block,
                                                    std::span<const std::uint32_t> old_index) const {
  std::vector<std::size_t> needed;
  std::size_t last = 0;
  const auto need = [&](std::uint32_t i) {
    if (old_index[i] == nobody) return;
    const std::size_t part = part_of(old_index[i], last);
    if (part == last && !needed.empty()) return;
    needed.push_back(last = part);
  };
  for (std::uint32_t i = block.begin; i < block.end; ++i) need(i);
  for (std::size_t p = 0; p < block.rim.count; ++p) need(block.rim.pairs[p].j);
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  return needed;
}

template <class Pair>
void GrainHistory::apply(PairList<Pair>& list, std::uint32_t begin, std::span<const std::uint32_t> old_index,
                         bool mark) {
  std::vector<double> found;
  found.reserve(list.count + 1);
  std::size_t last = 0;
  for (std::size_t p = 0; p < list.count; ++p) {
    const GrainPair pair = whole_pair(list.pairs[p], begin);
    const std::uint32_t a = old_index[pair.i], b = old_index[pair.j];
    if (a == nobody || b == nobody) continue;
    const std::uint32_t low = std::min(a, b), high = std::max(a, b);
    Part& part = parts_[last = part_of(low, last)];
    for (std::uint32_t e = start_[low]; e < start_[low + 1]; ++e) {
      Entry& entry = part.at(e);
      if (entry.other != high) continue;
      const Vec3 spring = a < b ? entry.spring : -entry.spring;
      found.push_back(spring.x), found.push_back(spring.y), found.push_back(spring.z);
      list.stretched[p / 4] = static_cast<std::uint8_t>(list.stretched[p / 4] | 1u << p % 4);
      // A rim pair is listed from both sides; one of them marks, so that threads do not write the same flag.
      if (mark || pair.i < pair.j) entry.found = true;
      break;
    }
  }
  found.push_back(0.0);
  list.springs.assign(found.begin(), found.end());
}

void GrainHistory::Part::close() {
  for (const Entry& entry : entries)
    if (!entry.found) lost.push_back(squared_norm(entry.spring));
  entries = std::vector<Entry>();  // `= {}` would keep the memory
}

void GrainHistory::apply(std::vector<GrainBlock>& blocks, std::span<const std::uint32_t> old_index, int threads) {
  const auto count = static_cast<int>(blocks.size());
  std::vector<std::vector<std::size_t>> needed(blocks.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int b = 0; b < count; ++b)
    needed[static_cast<std::size_t>(b)] = parts_needed(blocks[static_cast<std::size_t>(b)], old_index);
  for (const auto& block : needed)
    for (const std::size_t part : block) ++parts_[part].asked_by;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int b = 0; b < count; ++b) {
    GrainBlock& block = blocks[static_cast<std::size_t>(b)];
    apply(block.inner, block.begin, old_index, true);
    apply(block.rim, block.begin, old_index, false);
    for (const std::size_t part : needed[static_cast<std::size_t>(b)])
      if (parts_[part].asked_by.fetch_sub(1) == 1) parts_[part].close();  // it was the last
  }
}

double GrainHistory::finish() {
  double lost = 0.0;
  for (Part& part : parts_) {
    part.close();
    for (const double square : part.lost) lost += square;
  }
  start_ = std::vector<std::uint32_t>(), parts_ = std::vector<Part>();
  return lost;
}

std::vector<GrainSpring> stretched_springs(const std::vector<GrainBlock>& blocks, std::span<const std::uint32_t> ids) {
  std::vector<GrainSpring> springs;
  for (const GrainBlock& block : blocks)
    for_each_spring(block, [&](std::uint32_t i, std::uint32_t j, const Vec3& spring) {
      springs.push_back({ids[i], ids[j], spring});
    });
  return springs;
}

}  // namespace standoff::particles
