#pragma once
// Cells for the search of neighbours in a cloud that starts as a dense ball and ends thinner than air.
//
// The grid is folded: cell (i, j, k) of unbounded space is stored at (i mod nx, j mod ny, k mod nz). So it needs no
// bounding box, its memory is a few cells a point whatever the cloud does, and a dense core keeps small cells while
// fast outliers fly.
//
//        space   ..|0|1|2|3|4|5|6|7|8|9|..        Points far apart can share a stored cell. They show up as candidates
//        and stored    |0|1|2|3|0|1|2|3|0|1|..        the exact test rejects them: a cost, never an error.
//
// Points are sorted by stored cell (counting sort, stable), x fastest: the cells of one x-row within reach are one run
// of consecutive points. The same fold with nx = period / cell gives a periodic scene for free.
//
// Data: start(c) .. start(c + 1) are positions in the sorted order of the points in stored cell c; order()[p] is the
// point. There are more cells than points, so starts are kept short: sixteen cells are a row, which has its start in
// full and one byte a cell for the points of the row before the cell; only when a row holds more than a byte can count
// do all cells have their start in full.
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/periodic_images.hpp"

namespace standoff::particles {

class GasCellGrid {
 public:
  /// Chooses cells for about `count` points that will be asked for neighbours within `reach` [m]; a scene that repeats
  /// is folded after its period, across x and y at least.
  void shape(std::size_t count, double reach, const Period& period = {});

  /// Sorts the points; afterwards order() lists them cell by cell.
  void sort(std::span<const Vec3> points);
  /// The same for points that are worked out when they are asked for, at(i); `scratch` holds one number a point.
  template <class At>
  void sort(std::size_t count, At&& at, std::span<std::uint32_t> scratch);
  std::span<const std::uint32_t> order() const { return order_; }

  /// Calls body(begin, end) with runs of the sorted order that together hold every point within `reach` of `centre`.
  template <bool Periodic, class Body>
  void visit(const Vec3& centre, double reach, Body&& body) const;

 private:
  static int floor_to_int(double x) { return static_cast<int>(std::floor(x)); }
  static int modulo(int i, int n) {
    const int rest = i % n;
    return rest < 0 ? rest + n : rest;
  }
  template <bool Periodic>
  static int fold(int i, int n) {
    if constexpr (Periodic) return modulo(i, n);
    return i & (n - 1);  // n is a power of two; right for negative i too
  }
  /// Distance from x to the cell [i, i+1] cell widths.
  static double outside(double x, int i, double width) {
    const double low = i * width - x, high = x - (i + 1) * width;
    return low > 0.0 ? low : high > 0.0 ? high : 0.0;
  }
  std::uint32_t stored_cell(const Vec3& point) const;
  void start_counting(std::size_t points);
  void sort_by(std::span<const std::uint32_t> cell);
  std::uint32_t start(std::uint32_t cell) const {
    return full_.empty() ? row_start_[cell / cells_a_row] + before_[cell] : full_[cell];
  }
  template <class Body>
  [[gnu::always_inline]] void visit_row(std::uint32_t row, int first, int last, Body&& body) const;

  bool periodic_ = false;
  int nx_ = 0, ny_ = 0, nz_ = 0;
  Vec3 width_, inverse_width_;
  static constexpr std::uint32_t cells_a_row = 16;  // bytes of an SSE register
  std::vector<std::uint32_t> row_start_, order_, full_;
  std::vector<std::uint8_t> before_;
};

template <class At>
void GasCellGrid::sort(std::size_t count, At&& at, std::span<std::uint32_t> scratch) {
  start_counting(count);
  for (std::size_t i = 0; i < count; ++i) {
    scratch[i] = stored_cell(at(i));
    ++row_start_[scratch[i] / cells_a_row];
  }
  sort_by(scratch.first(count));
}

template <class Body>
inline void GasCellGrid::visit_row(std::uint32_t row, int first, int last, Body&& body) const {
  // first and last are folded; a run that wraps round the end of the row comes in two parts.
  const auto a = row + static_cast<std::uint32_t>(first), b = row + static_cast<std::uint32_t>(last) + 1;
  const auto run = [&](std::uint32_t from, std::uint32_t to) {
    const std::uint32_t begin = start(from), end = start(to);
    if (begin < end) body(begin, end);
  };
  if (a < b) return run(a, b);
  run(a, row + static_cast<std::uint32_t>(nx_));
  run(row, b);
}

template <bool Periodic, class Body>
void GasCellGrid::visit(const Vec3& centre, double reach, Body&& body) const {
  const double square = reach * reach * (1.0 + 1e-12);
  int z0 = floor_to_int((centre.z - reach) * inverse_width_.z),
      z1 = floor_to_int((centre.z + reach) * inverse_width_.z);
  int y0 = floor_to_int((centre.y - reach) * inverse_width_.y),
      y1 = floor_to_int((centre.y + reach) * inverse_width_.y);
  const bool whole_y = y1 - y0 >= ny_, whole_z = z1 - z0 >= nz_;  // more cells in reach than stored: each once
  if (whole_z) z0 = 0, z1 = nz_ - 1;
  if (whole_y) y0 = 0, y1 = ny_ - 1;
  const int x0 = floor_to_int((centre.x - reach) * inverse_width_.x);
  const int x1 = floor_to_int((centre.x + reach) * inverse_width_.x);
  const bool whole_x = x1 - x0 + 1 >= nx_;
  const int first = whole_x ? 0 : fold<Periodic>(x0, nx_), last = whole_x ? nx_ - 1 : fold<Periodic>(x1, nx_);
  for (int z = z0; z <= z1; ++z) {
    const double dz = whole_z ? 0.0 : outside(centre.z, z, width_.z);
    for (int y = y0; y <= y1; ++y) {
      const double dy = whole_y ? 0.0 : outside(centre.y, y, width_.y);
      if (dz * dz + dy * dy > square) continue;
      const auto row = static_cast<std::uint32_t>((fold<Periodic>(z, nz_) * ny_ + fold<Periodic>(y, ny_)) * nx_);
      visit_row(row, first, last, body);
    }
  }
}

}  // namespace standoff::particles
