#include "particle_solver/search/grain_pairs.hpp"

#include <algorithm>

namespace standoff::particles {

namespace {

/// Grains a block should have: enough to keep the rim small, few enough to share small scenes between threads.
std::size_t block_size(std::size_t grains) {
  return std::clamp<std::size_t>(grains / 12, 64, 2048);
}

void cut_blocks(const GrainCells& cells, std::size_t grains, std::vector<GrainBlock>& blocks) {
  const std::size_t wanted = block_size(grains), bricks = cells.bricks().size();
  std::size_t used = 0;
  for (std::size_t first = 0; first < bricks;) {
    std::size_t last = first;
    const std::uint32_t begin = cells.first(first, 0);
    while (last < bricks && cells.first(last, 0) - begin < wanted) ++last;
    if (used == blocks.size()) blocks.emplace_back();
    GrainBlock& block = blocks[used++];
    block.begin = begin, block.end = cells.first(last, 0);
    block.first_brick = first, block.last_brick = last;
    first = last;
  }
  blocks.resize(used);
}

/// Decides whether two grains are near enough to be listed.
struct NearTest {
  std::span<const GrainRecord> grains;
  PairListOptions options;
  Vec3 per_box;

  NearTest(std::span<const GrainRecord> all, const PairListOptions& o) : grains(all), options(o) {
    if (o.box) per_box = {1.0 / o.box->x, 1.0 / o.box->y, 1.0 / o.box->z};
  }
  bool operator()(const GrainRecord& a, const GrainRecord& b) const {
    double dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
    if (options.box) {
      dx -= options.box->x * nearest_integer(dx * per_box.x);
      dy -= options.box->y * nearest_integer(dy * per_box.y);
      dz -= options.box->z * nearest_integer(dz * per_box.z);
    }
    const double reach = options.radii ? a.w + b.w + options.skin : options.cutoff;
    return dx * dx + dy * dy + dz * dz < reach * reach;
  }
};

struct Range {
  std::uint32_t begin, end;
};

/// Lists the pairs of grain i with the grains of one other range. The whole range lies in the block or outside of it.
void list_range(const NearTest& near, GrainBlock& block, std::uint32_t i, Range others) {
  PairList& list = others.begin >= block.begin && others.begin < block.end ? block.inner : block.rim;
  const GrainRecord& self = near.grains[i];
  for (std::uint32_t j = others.begin; j < others.end; ++j)
    if (near(self, near.grains[j])) list.pairs.push_back({i, j});
}

/// Ranges of grains around a cell that its block must look at: later cells of the block, all cells of other blocks.
std::size_t ranges_around(const GrainCells& cells, const GrainBlock& block, CellIndex cell, std::uint32_t self_end,
                          std::array<Range, 27>& ranges) {
  std::size_t used = 0;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0 && dz == 0) continue;
        unsigned code = 0;
        const int brick = cells.find({cell.x + dx, cell.y + dy, cell.z + dz}, code);
        if (brick < 0) continue;
        const auto b = static_cast<std::size_t>(brick);
        const Range range{cells.first(b, code), cells.first(b, code + 1)};
        if (range.begin == range.end) continue;
        if (range.begin >= block.begin && range.begin < self_end)
          continue;  // earlier cell of this block: has us listed
        ranges[used++] = range;
      }
  return used;
}

void list_block(const GrainCells& cells, const NearTest& near, GrainBlock& block) {
  std::array<Range, 27> ranges;
  for (std::size_t b = block.first_brick; b < block.last_brick; ++b) {
    const CellIndex brick = cells.bricks()[b].at;
    for (unsigned code = 0; code < 64; ++code) {
      const std::uint32_t begin = cells.first(b, code), end = cells.first(b, code + 1);
      if (begin == end) continue;
      const CellIndex in = GrainCells::cell_of(code);
      const CellIndex cell{4 * brick.x + in.x, 4 * brick.y + in.y, 4 * brick.z + in.z};
      const std::size_t used = ranges_around(cells, block, cell, end, ranges);
      for (std::uint32_t i = begin; i < end; ++i) {
        list_range(near, block, i, {i + 1, end});
        for (std::size_t r = 0; r < used; ++r) list_range(near, block, i, ranges[r]);
      }
    }
  }
}

/// A periodic box of fewer than three cells: cells would meet themselves, so compare all with all.
void list_all(const NearTest& near, GrainBlock& block, std::uint32_t grains) {
  for (std::uint32_t i = block.begin; i < block.end; ++i) {
    list_range(near, block, i, {0, block.begin});
    list_range(near, block, i, {i + 1, block.end});
    list_range(near, block, i, {block.end, grains});
  }
}

void fill_up(PairList& list, std::uint32_t begin, std::uint32_t far_away, bool springs) {
  list.count = list.pairs.size();
  while (list.pairs.size() % 4 != 0) list.pairs.push_back({begin, far_away});
  if (!springs) return;
  list.springs.assign(list.groups(), {});
  list.stretched.assign(list.groups(), 0);
}

}  // namespace

void list_grain_pairs(const GrainCells& cells, std::span<const GrainRecord> grains, const PairListOptions& options,
                      std::vector<GrainBlock>& blocks) {
  const auto count = static_cast<std::uint32_t>(grains.size() - 1);
  cut_blocks(cells, count, blocks);
  const NearTest near(grains, options);
  const auto blocks_count = static_cast<int>(blocks.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(options.threads)
  for (int b = 0; b < blocks_count; ++b) {
    GrainBlock& block = blocks[static_cast<std::size_t>(b)];
    block.inner.pairs.clear(), block.rim.pairs.clear();
    if (cells.too_small())
      list_all(near, block, count);
    else
      list_block(cells, near, block);
    fill_up(block.inner, block.begin, count, options.springs);
    fill_up(block.rim, block.begin, count, options.springs);
  }
}

}  // namespace standoff::particles
