// Law: every two grains nearer than the cutoff are listed so that both get the force: once as an inner pair, which
// serves both, or as a rim pair from each side. Compared with the search of all pairs, so no tolerance.
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "particle_solver/search/grain_pairs.hpp"

namespace standoff::particles {
namespace {

constexpr std::size_t count = 900;
constexpr double cutoff = 0.12;

struct Listed {
  explicit Listed(std::uint32_t longest_offset) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> within(0.0, 1.0);
    std::vector<Vec3> points(count);
    for (Vec3& p : points) p = {within(random), within(random), within(random)};
    GrainCells cells;
    cells.build(points, cutoff, nullptr);
    for (const std::uint32_t s : cells.order()) grains.push_back({points[s].x, points[s].y, points[s].z, 0.0});
    grains.push_back({1e100, 1e100, 1e100, 0.0});
    PairListOptions options;
    options.cutoff = cutoff, options.springs = true, options.longest_offset = longest_offset;
    list_grain_pairs(cells, grains, options, blocks);
    for (const GrainBlock& block : blocks) inner += block.inner.count, rim += block.rim.count;
  }
  /// How often each ordered pair (i, j) gives its force to i.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> given() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> times;
    for (const GrainBlock& block : blocks) {
      for (std::size_t p = 0; p < block.inner.count; ++p) {
        const GrainPair pair = whole_pair(block.inner.pairs[p], block.begin);
        ++times[{pair.i, pair.j}], ++times[{pair.j, pair.i}];
      }
      for (std::size_t p = 0; p < block.rim.count; ++p) {
        const GrainPair pair = block.rim.pairs[p];
        EXPECT_TRUE(pair.i >= block.begin && pair.i < block.end) << "the force would go to another block's grain";
        ++times[{pair.i, pair.j}];
      }
    }
    return times;
  }
  std::vector<GrainRecord> grains;
  std::vector<GrainBlock> blocks;
  std::size_t inner = 0, rim = 0;
};

void expect_complete(const Listed& listed) {
  const auto given = listed.given();
  std::size_t near = 0;
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t j = 0; j < count; ++j) {
      const GrainRecord &a = listed.grains[i], &b = listed.grains[j];
      if (i == j || !(squared_norm(Vec3{a.x - b.x, a.y - b.y, a.z - b.z}) < cutoff * cutoff)) continue;
      ++near;
      const auto found = given.find({i, j});
      EXPECT_EQ(found == given.end() ? 0 : found->second, 1) << "grains " << i << " and " << j;
    }
  EXPECT_EQ(given.size(), near);
}

TEST(GrainPairs, BlocksOfRandomGrains_ListEachPairOnceForEachGrain) {
  const Listed listed(0xFFFF);
  EXPECT_GT(listed.blocks.size(), 2u);
  EXPECT_GT(listed.inner, 0u);
  EXPECT_GT(listed.rim, 0u);
  expect_complete(listed);
}

TEST(GrainPairs, OffsetsThatDoNotFit_AreListedFromBothSides) {
  const Listed all(0xFFFF), some(20);
  EXPECT_LT(some.inner, all.inner);
  EXPECT_GT(some.inner, 0u);
  EXPECT_EQ(some.rim + 2 * some.inner, all.rim + 2 * all.inner);
  expect_complete(some);
}

}  // namespace
}  // namespace standoff::particles
