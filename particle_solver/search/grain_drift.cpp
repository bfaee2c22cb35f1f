#include "particle_solver/search/grain_drift.hpp"

#include <algorithm>

namespace standoff::particles {

namespace {

/// The thirteen of 26 neighbours that come later: each pair of neighbours once.
constexpr std::array<CellIndex, 13> forward = {{{1, 0, 0},
                                                {-1, 1, 0},
                                                {0, 1, 0},
                                                {1, 1, 0},
                                                {-1, -1, 1},
                                                {0, -1, 1},
                                                {1, -1, 1},
                                                {-1, 0, 1},
                                                {0, 0, 1},
                                                {1, 0, 1},
                                                {-1, 1, 1},
                                                {0, 1, 1},
                                                {1, 1, 1}}};

/// Square of the diagonal of the box around two boxes: bounds any relative displacement between them.
double diagonal2(const DriftBox& a, const DriftBox& b) {
  const Lanes extent =
      larger(load(a.high.data()), load(b.high.data())) + larger(-load(a.low.data()), -load(b.low.data()));
  const Lanes square = extent * extent;
  return square[0] + square[1] + square[2];
}

}  // namespace

void GrainDrift::restart(const GrainCells& cells, double contact, double skin) {
  regions_.clear(), near_regions_.clear(), near_bricks_.clear(), first_region_.clear();
  one_region_ = !cells.bricks_are_whole(), skin_ = skin;
  brick_reach_ = 2.0 * cells.edge() - contact, far_reach_ = 4.0 * cells.edge() - contact;
  const std::size_t bricks = cells.bricks().size();
  std::vector<std::uint32_t> region_at(bricks * 8, 0);
  for (std::size_t b = 0; b < bricks; ++b) {
    first_region_.push_back(static_cast<std::uint32_t>(regions_.size()));
    for (unsigned sub = 0; sub < 8; ++sub) {
      const std::uint32_t begin = cells.first(b, 8 * sub), end = cells.first(b, 8 * sub + 8);
      region_at[b * 8 + sub] = static_cast<std::uint32_t>(regions_.size());
      if (begin < end) regions_.push_back({begin, end, static_cast<std::uint32_t>(b)});
    }
  }
  first_region_.push_back(static_cast<std::uint32_t>(regions_.size()));
  boxes_.assign(regions_.size(), {});
  if (one_region_) return;

  const auto region_of = [&](CellIndex sub) -> int {
    const int b = cells.find_brick({sub.x >> 1, sub.y >> 1, sub.z >> 1});
    if (b < 0) return -1;
    const unsigned place = static_cast<unsigned>((sub.x & 1) | (sub.y & 1) << 1 | (sub.z & 1) << 2);
    const auto brick = static_cast<std::size_t>(b);
    if (cells.first(brick, 8 * place) == cells.first(brick, 8 * place + 8)) return -1;
    return static_cast<int>(region_at[brick * 8 + place]);
  };
  for (std::size_t b = 0; b < bricks; ++b) {
    const CellIndex at = cells.bricks()[b].at;
    for (const CellIndex& step : forward) {
      const int other = cells.find_brick({at.x + step.x, at.y + step.y, at.z + step.z});
      if (other >= 0) near_bricks_.emplace_back(static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(other));
    }
    for (int sub = 0; sub < 8; ++sub) {
      const CellIndex self{2 * at.x + (sub & 1), 2 * at.y + (sub >> 1 & 1), 2 * at.z + (sub >> 2 & 1)};
      const int a = region_of(self);
      if (a < 0) continue;
      near_regions_.emplace_back(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(a));
      for (const CellIndex& step : forward) {
        const int other = region_of({self.x + step.x, self.y + step.y, self.z + step.z});
        if (other >= 0) near_regions_.emplace_back(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(other));
      }
    }
  }
}

double GrainDrift::used(int threads, double stretch) const {
  const std::size_t bricks = first_region_.empty() ? 0 : first_region_.size() - 1;
  std::vector<DriftBox> brick_boxes(bricks);
  DriftBox all;
  for (std::size_t b = 0; b < bricks; ++b) {
    for (std::uint32_t r = first_region_[b]; r < first_region_[b + 1]; ++r) brick_boxes[b].add(boxes_[r]);
    all.add(brick_boxes[b]);
  }
  if (bricks == 0) return 0.0;
  const double everywhere = std::sqrt(diagonal2(all, all));
  if (one_region_) return (everywhere + stretch) / skin_;
  if (everywhere <= skin_) return everywhere / skin_;  // nothing moved far: no need to look closer

  double near = 0.0, mid = 0.0;
  const auto pairs = static_cast<long>(near_regions_.size());
#pragma omp parallel for reduction(max : near) num_threads(threads)
  for (long p = 0; p < pairs; ++p) {
    const auto& [a, b] = near_regions_[static_cast<std::size_t>(p)];
    near = std::max(near, diagonal2(boxes_[a], boxes_[b]));
  }
  for (const auto& [a, b] : near_bricks_) mid = std::max(mid, diagonal2(brick_boxes[a], brick_boxes[b]));
  for (const DriftBox& box : brick_boxes) mid = std::max(mid, diagonal2(box, box));
  return std::max({std::sqrt(near) / skin_, std::sqrt(mid) / brick_reach_, everywhere / far_reach_});
}

}  // namespace standoff::particles
