#pragma once
// The cells of ambient air: where it stands still, where it is simulated, and who is in which cell.
//
//      z ^   | asleep | asleep | AWAKE  |        asleep   ambient air at rest: known without particles, costs nothing
//        |   | asleep | AWAKE  | AWAKE  |        awake    simulated; once awake, awake to the end
//        0 --+========+========+---open-+        wall     below the loaded face: empty until a dent opens it, then
//            |  wall  |  wall  |outside |                 part of the flow, never filled or fed
//            plate and cover               outside  beyond the box, and beside and behind the cover: ambient for ever
//
// A face between an awake cell and one that is asleep or outside is a source: what still air sends through it is
// injected, what flies through it is taken out. Cell boundaries lie in the planes x = 0, y = 0 and z = 0, so mirrors
// and the plate never cut a cell; in a scene that repeats across x and y they lie in its faces instead.
//
// Data: cells numbered x fastest; sort() lists points cell by cell (counting sort, stable).
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

enum class AirCell : std::uint8_t { asleep, awake, wall, outside };

struct AirCellsOptions {
  Vec3 lower, upper;                    // m, domain box; lower.x = lower.y = 0 with mirrors
  double size = 0.0;                    // m, wanted edge
  double cover_x = 0.0, cover_y = 0.0;  // m, half widths of plate and cover, which lie in z = 0; 0: there is none
  bool mirrors = false;
  bool closed = false;   // reflecting box: nothing beyond it sends or takes
  bool repeats = false;  // across x and y: beyond a face are the cells at the opposite one
};

/// One face that still air sends through.
struct AirSource {
  std::uint32_t cell = 0;  // the awake one
  int axis = 0;            // 0 x, 1 y, 2 z
  double sign = 1.0;       // direction of the inflow along the axis
};

class AirCells {
 public:
  explicit AirCells(const AirCellsOptions& options);

  std::size_t count() const { return state_.size(); }
  AirCell state(std::uint32_t cell) const { return state_[cell]; }
  double volume() const { return width_.x * width_.y * width_.z; }
  const Vec3& width() const { return width_; }
  Vec3 lower_corner(std::uint32_t cell) const;
  /// `outside_cell` for a point beyond the box.
  static constexpr std::uint32_t outside_cell = 0xFFFFFFFFu;
  std::uint32_t cell_of(const Vec3& point) const;
  AirCell state_at(const Vec3& point) const {
    const std::uint32_t cell = cell_of(point);
    return cell == outside_cell ? AirCell::outside : state_[cell];
  }
  bool beside_cover(const Vec3& point) const {
    return options_.cover_x <= 0.0 || std::abs(point.x) > options_.cover_x || std::abs(point.y) > options_.cover_y;
  }
  /// Whether the column over (x, y) is awake where it meets the plate.
  bool awake_over_plate(double x, double y) const { return state_at({x, y, 0.5 * width_.z}) == AirCell::awake; }

  /// Notes that something happens in the cell of `point`: its neighbours, 26 of them, are to wake with it.
  void disturb(const Vec3& point);
  /// Wakes what was noted; returns the newly woken cells, ascending.
  const std::vector<std::uint32_t>& wake();
  void wake_all();  // of the ambient ones
  std::span<const AirSource> sources() const { return sources_; }
  std::size_t awake_count() const { return awake_; }

  /// Listing of points by cell; points outside are in no cell.
  struct Listing {
    std::vector<std::uint32_t> start, order, cell;
    std::span<const std::uint32_t> in(std::uint32_t c) const {
      return std::span(order).subspan(start[c], start[c + 1] - start[c]);
    }
  };
  template <class Select>
  void sort(std::span<const Vec3> points, Select&& wanted, Listing& out) const;

  template <class Archive>
  void archive(Archive& a) {
    a(state_, awake_, sources_);
  }

 private:
  bool repeats(std::size_t axis) const { return options_.repeats && axis < 2; }
  std::array<int, 3> index_of(std::uint32_t cell) const;
  /// Cell `step` cells on along `axis`; `outside_cell` beyond the box.
  std::uint32_t next_to(std::uint32_t cell, int axis, int step) const;
  bool reaches_beside_cover(std::uint32_t cell) const;
  AirCell beyond(std::uint32_t cell, int axis, int side) const;
  bool is_source(std::uint32_t cell, int axis, int side) const;
  void renew_sources();
  AirCell kind_at_start(const std::array<int, 3>& index) const;

  AirCellsOptions options_;
  Vec3 width_, inverse_width_, origin_;
  int n_[3] = {0, 0, 0};
  std::vector<AirCell> state_;
  std::vector<std::uint8_t> noted_;
  std::vector<std::uint32_t> noted_cells_, woken_;
  std::vector<AirSource> sources_;
  std::size_t awake_ = 0;
};

template <class Select>
void AirCells::sort(std::span<const Vec3> points, Select&& wanted, Listing& out) const {
  out.start.assign(count() + 1, 0);
  if (out.cell.capacity() < points.size()) {  // no doubling: awake air grows for ever
    out.cell.reserve(points.size() + points.size() / 16);
    out.order.reserve(points.size() + points.size() / 16);
  }
  out.cell.resize(points.size());
  std::uint32_t listed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t c = wanted(i) ? cell_of(points[i]) : outside_cell;
    out.cell[i] = c;
    if (c != outside_cell) ++out.start[c], ++listed;
  }
  out.order.resize(listed);
  std::uint32_t sum = 0;
  for (std::uint32_t& s : out.start) s = sum += s;
  for (std::size_t i = points.size(); i-- > 0;)
    if (out.cell[i] != outside_cell) out.order[--out.start[out.cell[i]]] = static_cast<std::uint32_t>(i);
}

}  // namespace standoff::particles
