#pragma once
// Which regions of space have gas nearby: a cheap filter, so that only grains that gas can reach in a sub-step are
// looked at. Cells of the width of the reach, folded like GasCellGrid; a cell is near when it or one of its 26
// neighbours holds gas. A false "near" (two regions folded together) costs a look, a false "far" cannot happen for
// points within one cell width. A scene that repeats is folded after its period instead.
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/periodic_images.hpp"

namespace standoff::particles {

class GasNearMap {
 public:
  /// Marks everything within `reach` [m] of the points.
  void mark(std::span<const Vec3> points, double reach, const Period& period = {});
  template <class At>
  void mark(std::size_t count, At&& at, double reach, const Period& period = {});
  template <bool Periodic>
  bool near(const Vec3& point) const;

 private:
  struct Cell {
    int x, y, z;
  };
  template <bool Periodic>
  Cell cell_of(const Vec3& point) const;
  template <bool Periodic>
  std::size_t stored(int x, int y, int z) const;
  void clear(std::size_t points, double reach, const Period& period);
  template <bool Periodic>
  void mark(const Vec3& point);

  double inverse_width_ = 0.0;
  int mask_ = 0;
  Vec3 per_width_;  // 1/m; a scene that repeats: cells that fill its period, and their number
  int nx_ = 0, ny_ = 0;
  static constexpr std::uint8_t holds = 3, is_near = 1;  // what holds gas is near it
  std::vector<std::uint8_t> flags_;
};

/// Points that are worked out when they are asked for, at(i).
template <class At>
void GasNearMap::mark(std::size_t count, At&& at, double reach, const Period& period) {
  clear(count, reach, period);
  if (period.on())
    for (std::size_t i = 0; i < count; ++i) mark<true>(at(i));
  else
    for (std::size_t i = 0; i < count; ++i) mark<false>(at(i));
}

}  // namespace standoff::particles
