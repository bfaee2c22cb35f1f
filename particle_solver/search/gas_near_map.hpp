#pragma once
// Which regions of space have gas nearby: a cheap filter, so that only grains that gas can reach in a sub-step are
// looked at. Cells of the width of the reach, folded like GasCellGrid; a cell is near when it or one of its 26
// neighbours holds gas. A false "near" (two regions folded together) costs a look, a false "far" cannot happen for
// points within one cell width.
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

class GasNearMap {
 public:
  /// Marks everything within `reach` [m] of the points.
  void mark(std::span<const Vec3> points, double reach);
  template <class At>
  void mark(std::size_t count, At&& at, double reach);
  bool near(const Vec3& point) const;

 private:
  struct Cell {
    int x, y, z;
  };
  Cell cell_of(const Vec3& point) const;
  std::size_t stored(int x, int y, int z) const {
    return static_cast<std::size_t>(((z & mask_) * (mask_ + 1) + (y & mask_)) * (mask_ + 1) + (x & mask_));
  }
  void clear(std::size_t points, double reach);
  void mark(const Vec3& point);

  double inverse_width_ = 0.0;
  int mask_ = 0;
  static constexpr std::uint8_t holds = 3, is_near = 1;  // what holds gas is near it
  std::vector<std::uint8_t> flags_;
};

/// Points that are worked out when they are asked for, at(i).
template <class At>
void GasNearMap::mark(std::size_t count, At&& at, double reach) {
  clear(count, reach);
  for (std::size_t i = 0; i < count; ++i) mark(at(i));
}

}  // namespace standoff::particles
