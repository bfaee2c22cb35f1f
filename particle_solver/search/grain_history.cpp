#include "particle_solver/search/grain_history.hpp"

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
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int b = 0; b < blocks_count; ++b)
    for_each_spring(blocks[static_cast<std::size_t>(b)],
                    [&](std::uint32_t i, std::uint32_t, const Vec3&) { ++start_[i + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  entries_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int b = 0; b < blocks_count; ++b) {
    GrainBlock& block = blocks[static_cast<std::size_t>(b)];
    for_each_spring(block, [&](std::uint32_t i, std::uint32_t j, const Vec3& spring) {
      entries_[next[i]++] = {j, false, spring};
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
  entries_.resize(keys.size());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t e = 0; e < keys.size(); ++e) entries_[next[keys[e]]++] = found[e];
}

template <class Pair>
void GrainHistory::apply(PairList<Pair>& list, std::uint32_t begin, std::span<const std::uint32_t> old_index,
                         bool mark) {
  std::vector<double> found;
  for (std::size_t p = 0; p < list.count; ++p) {
    const GrainPair pair = whole_pair(list.pairs[p], begin);
    const std::uint32_t a = old_index[pair.i], b = old_index[pair.j];
    if (a == nobody || b == nobody) continue;
    const std::uint32_t low = std::min(a, b), high = std::max(a, b);
    for (std::uint32_t e = start_[low]; e < start_[low + 1]; ++e) {
      Entry& entry = entries_[e];
      if (entry.other != high) continue;
      const Vec3 spring = a < b ? entry.spring : -entry.spring;
      found.insert(found.end(), {spring.x, spring.y, spring.z});
      list.stretched[p / 4] = static_cast<std::uint8_t>(list.stretched[p / 4] | 1u << p % 4);
      // A rim pair is listed from both sides; one of them marks, so that threads do not write the same flag.
      if (mark || pair.i < pair.j) entry.found = true;
      break;
    }
  }
  found.push_back(0.0);
  list.springs.assign(found.begin(), found.end());
}

void GrainHistory::apply(std::vector<GrainBlock>& blocks, std::span<const std::uint32_t> old_index, int threads) {
  const auto count = static_cast<int>(blocks.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (int b = 0; b < count; ++b) {
    GrainBlock& block = blocks[static_cast<std::size_t>(b)];
    apply(block.inner, block.begin, old_index, true);
    apply(block.rim, block.begin, old_index, false);
  }
}

double GrainHistory::finish() {
  double lost = 0.0;
  for (const Entry& entry : entries_)
    if (!entry.found) lost += squared_norm(entry.spring);
  start_ = {}, entries_ = {};
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
