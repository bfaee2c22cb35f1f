#include "particle_solver/search/grain_pairs.hpp"

#include <algorithm>
#include <bit>

namespace standoff::particles {

namespace {

/// Grains a block should have: enough to keep the rim small, few enough to share small scenes between threads.
std::size_t block_size(std::size_t grains) {
  return std::clamp<std::size_t>(grains / 12, 64, 4096);
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

struct Range {
  std::uint32_t begin, end;
};

/// Grains that one or several others may be near to, as arrays that can be read four at a time from any place.
class Candidates {
 public:
  void clear() { count_ = 0; }
  void add(std::span<const GrainRecord> grains, Range range) {
    const std::size_t needed = count_ + (range.end - range.begin) + padding;
    if (records_.size() < needed) {
      for (std::vector<double>* component : {&x_, &y_, &z_, &radius_}) component->resize(2 * needed);
      records_.resize(2 * needed), index_.resize(2 * needed), found_.resize(2 * needed);
    }
    for (std::uint32_t j = range.begin; j < range.end; ++j, ++count_) records_[count_] = grains[j], index_[count_] = j;
  }
  /// To be called once all are added.
  void close() {
    if (count_ == 0) return;
    for (std::size_t k = count_; k < count_ + padding; ++k) records_[k] = {};
    for (std::size_t k = 0; k < count_ + 3; k += 4) {
      Lanes x = load(records_[k]), y = load(records_[k + 1]), z = load(records_[k + 2]), radius = load(records_[k + 3]);
      transpose(x, y, z, radius);
      store_anywhere(&x_[k], x), store_anywhere(&y_[k], y), store_anywhere(&z_[k], z),
          store_anywhere(&radius_[k], radius);
    }
  }
  /// Lists the pairs of grain i with those from place `first` on that are near.
  template <bool Radii, bool Periodic>
  void list(const GrainRecord& self, std::uint32_t i, std::size_t first, const PairListOptions& options,
            std::vector<GrainPair>& pairs) {
    const Lanes x = all_lanes(self.x), y = all_lanes(self.y), z = all_lanes(self.z);
    std::size_t found = 0;
    for (std::size_t k = first; k < count_; k += 4) {
      Lanes dx = x - load_anywhere(&x_[k]), dy = y - load_anywhere(&y_[k]), dz = z - load_anywhere(&z_[k]);
      if constexpr (Periodic) {
        dx -= options.box->x * nearest_integer(dx * options.per_box.x);
        dy -= options.box->y * nearest_integer(dy * options.per_box.y);
        dz -= options.box->z * nearest_integer(dz * options.per_box.z);
      }
      Lanes reach = all_lanes(options.cutoff);
      if constexpr (Radii) reach = load_anywhere(&radius_[k]) + (self.w + options.skin);
      const auto near = dx * dx + dy * dy + dz * dz < reach * reach;
      unsigned bits = lane_bits(near);
      if (k + 4 > count_) bits &= (1u << (count_ - k)) - 1u;  // the filling
      found += append_chosen(bits, &index_[k], &found_[found]);
    }
    for (std::size_t k = 0; k < found; ++k) pairs.push_back({i, found_[k]});
  }

 private:
  static constexpr std::size_t padding = 8;  // a read of four may start at the last one; transposed by fours
  std::size_t count_ = 0;
  std::vector<GrainRecord> records_;
  std::vector<double> x_, y_, z_, radius_;
  std::vector<std::uint32_t> index_, found_;
};

/// What the grains of a cell must be compared with: itself and later cells of the block, all cells of other blocks.
struct Around {
  Candidates inner, rim;

  void start(std::span<const GrainRecord> grains, Range self) {
    inner.clear(), rim.clear();
    inner.add(grains, self);
  }
  void add(std::span<const GrainRecord> grains, const GrainBlock& block, Range self, Range other) {
    if (other.begin < block.begin || other.begin >= block.end)
      rim.add(grains, other);
    else if (other.begin >= self.end)  // an earlier cell of this block has us listed
      inner.add(grains, other);
  }
  void close() { inner.close(), rim.close(); }
};

/// Works on one block at a time; keeps its scratch.
template <bool Radii, bool Periodic>
class Lister {
 public:
  Lister(const GrainCells& cells, std::span<const GrainRecord> grains, const PairListOptions& options)
      : cells_(cells), grains_(grains), options_(options) {}

  void run(GrainBlock& block) {
    near_.clear(), far_.clear();
    cells_.too_small() ? run_all(block) : run_cells(block);
    pack(block);
  }

 private:
  void run_cells(const GrainBlock& block) {
    for (std::size_t b = block.first_brick; b < block.last_brick; ++b) {
      const bool whole = !Periodic || cells_.bricks_are_whole();
      if (whole) bricks_ = cells_.bricks_around(b);
      for (std::uint64_t left = cells_.occupied(b); left != 0; left &= left - 1) {
        const auto code = static_cast<unsigned>(std::countr_zero(left));
        const Range self = cell(b, code);
        around_.start(grains_, self);
        whole ? look_around(block, code, self) : look_around_wrapped(block, b, code, self);
        around_.close();
        list(self);
      }
    }
  }
  Range cell(std::size_t brick, unsigned code) const {
    return {cells_.first(brick, code), cells_.first(brick, code + 1)};
  }
  /// Visits the occupied ones of the 27 cells.
  void look_around(const GrainBlock& block, unsigned code, Range self) {
    const CellsAround& near = cells_around(code);
    for (std::size_t p = 0; p < near.count; ++p) {
      if (bricks_[near.parts[p].place] < 0) continue;
      const auto other = static_cast<std::size_t>(bricks_[near.parts[p].place]);
      for (std::uint64_t left = near.parts[p].cells & cells_.occupied(other); left != 0; left &= left - 1)
        around_.add(grains_, block, self, cell(other, static_cast<unsigned>(std::countr_zero(left))));
    }
  }
  /// The same in a small periodic box, where bricks at the end are not full.
  void look_around_wrapped(const GrainBlock& block, std::size_t b, unsigned code, Range self) {
    const CellIndex brick = cells_.bricks()[b].at, in = GrainCells::cell_of(code);
    for (int step = 0; step < 27; ++step) {
      unsigned other_code = 0;
      const int other = cells_.find(
          {4 * brick.x + in.x + step % 3 - 1, 4 * brick.y + in.y + step / 3 % 3 - 1, 4 * brick.z + in.z + step / 9 - 1},
          other_code);
      if (other >= 0 && step != 13)
        around_.add(grains_, block, self, cell(static_cast<std::size_t>(other), other_code));
    }
  }
  void list(Range self) {
    for (std::uint32_t i = self.begin; i < self.end; ++i) {
      around_.inner.template list<Radii, Periodic>(grains_[i], i, i - self.begin + 1, options_, near_);
      around_.rim.template list<Radii, Periodic>(grains_[i], i, 0, options_, far_);
    }
  }
  /// Moves what was found to the block, in lists of just the length.
  void pack(GrainBlock& block) {
    std::size_t kept = 0;
    for (const GrainPair pair : near_)
      if (std::max(pair.i, pair.j) - block.begin <= options_.longest_offset)
        near_[kept++] = pair;
      else
        far_.push_back(pair), far_.push_back({pair.j, pair.i});
    near_.resize(kept);
    fill(block.inner, near_, [&](GrainPair pair) {
      return NearPair{static_cast<std::uint16_t>(pair.i - block.begin),
                      static_cast<std::uint16_t>(pair.j - block.begin)};
    });
    fill(block.rim, far_, [](GrainPair pair) { return pair; });
  }
  template <class Pair, class Shorten>
  void fill(PairList<Pair>& list, const std::vector<GrainPair>& pairs, Shorten&& shorten) const {
    list.count = pairs.size();
    list.pairs = std::vector<Pair>(pairs.size() / 4 * 4 + 4);
    std::transform(pairs.begin(), pairs.end(), list.pairs.begin(), shorten);
    if (!options_.springs) return;
    list.springs.assign(1, 0.0);
    list.stretched = std::vector<std::uint8_t>(list.groups());
  }
  /// A periodic box of fewer than three cells: cells would meet themselves, so compare all with all.
  void run_all(const GrainBlock& block) {
    around_.start(grains_, {block.begin, block.end});
    around_.rim.add(grains_, {0, block.begin});
    around_.rim.add(grains_, {block.end, static_cast<std::uint32_t>(grains_.size() - 1)});
    around_.close();
    list({block.begin, block.end});
  }

  const GrainCells& cells_;
  std::span<const GrainRecord> grains_;
  const PairListOptions& options_;
  Around around_;
  std::vector<GrainPair> near_, far_;
  std::array<std::int32_t, 27> bricks_{};
};

template <bool Radii, bool Periodic>
void list_blocks(const GrainCells& cells, std::span<const GrainRecord> grains, const PairListOptions& options,
                 std::vector<GrainBlock>& blocks) {
  const auto count = static_cast<int>(blocks.size());
#pragma omp parallel num_threads(options.threads)
  {
    Lister<Radii, Periodic> lister(cells, grains, options);
#pragma omp for schedule(dynamic, 1)
    for (int b = 0; b < count; ++b) lister.run(blocks[static_cast<std::size_t>(b)]);
  }
}

}  // namespace

void list_grain_pairs(const GrainCells& cells, std::span<const GrainRecord> grains, const PairListOptions& options,
                      std::vector<GrainBlock>& blocks) {
  cut_blocks(cells, grains.size() - 1, blocks);
  if (options.radii)
    options.box ? list_blocks<true, true>(cells, grains, options, blocks)
                : list_blocks<true, false>(cells, grains, options, blocks);
  else
    options.box ? list_blocks<false, true>(cells, grains, options, blocks)
                : list_blocks<false, false>(cells, grains, options, blocks);
}

}  // namespace standoff::particles
