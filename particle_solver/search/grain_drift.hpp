#pragma once
// Is the pair list still complete? Watches how far grains moved *against their neighbours* since it was made.
//
// A body that flies at 500 m/s moves a whole skin in two steps, yet its grains hardly move against each other. So the
// usual rule (two largest displacements > skin) is applied between neighbouring regions only, with the box of
// displacements of each:
//
//   regions that touch (2x2x2 cells each)   unlisted pairs were > contact + skin apart   relative displacement < skin
//   bricks that touch (4x4x4 cells)         not neighbours above: > 2 edges apart         < 2 edges - contact
//   all other                               > 4 edges apart                               < 4 edges - contact
//
// A packed cell uses one region; in a scene that repeats bricks touch across its faces. The result is a maximum of
// numbers, so it does not depend on the order of evaluation.
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "particle_solver/kernels/grain_lanes.hpp"
#include "particle_solver/search/grain_cells.hpp"

namespace standoff::particles {

/// Smallest box around displacements [m]; the fourth component is unused.
struct alignas(32) DriftBox {
  std::array<double, 4> low{1e300, 1e300, 1e300, 0.0}, high{-1e300, -1e300, -1e300, 0.0};
  void add(Lanes displacement) {
    store(low.data(), -larger(-load(low.data()), -displacement));
    store(high.data(), larger(load(high.data()), displacement));
  }
  void add(const DriftBox& other) {
    store(low.data(), -larger(-load(low.data()), -load(other.low.data())));
    store(high.data(), larger(load(high.data()), load(other.high.data())));
  }
};

class GrainDrift {
 public:
  struct Region {
    std::uint32_t begin = 0, end = 0;  // sorted grains
    std::uint32_t brick = 0;
  };

  /// Starts anew for freshly sorted cells; `contact` is the largest centre distance of two touching grains.
  void restart(const GrainCells& cells, double contact, double skin);
  const std::vector<Region>& regions() const { return regions_; }
  DriftBox& box(std::size_t region) { return boxes_[region]; }
  /// Largest relative displacement over what is allowed; above 1 the list must be made anew. `stretch`: m by which a
  /// periodic box changed since then.
  double used(int threads, double stretch) const;

 private:
  using Neighbours = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  std::vector<Region> regions_;
  std::vector<DriftBox> boxes_;
  Neighbours near_regions_, near_bricks_;
  std::vector<std::uint32_t> first_region_;  // of each brick, and one past the last
  double skin_ = 0.0, brick_reach_ = 0.0, far_reach_ = 0.0;
  bool one_region_ = false;
};

}  // namespace standoff::particles
