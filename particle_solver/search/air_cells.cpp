#include "particle_solver/search/air_cells.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::particles {
namespace {

/// Cells of about `wanted` that fill [from, to].
int cells_in(double from, double to, double wanted) {
  return std::max(1, static_cast<int>(std::ceil((to - from) / wanted * (1.0 - 1e-9))));
}

}  // namespace

AirCells::AirCells(const AirCellsOptions& options) : options_(options) {
  const Vec3 &low = options.lower, &high = options.upper;
  // A boundary in every plane of symmetry and in the loaded face: counted from 0 to both sides.
  const auto axis = [&](double from, double to, double& width, double& origin) {
    const int above = cells_in(0.0, to, options.size);
    width = to / above;
    const int below = from < 0.0 ? cells_in(from, 0.0, width) : 0;
    origin = -below * width;
    return above + below;
  };
  const auto between_faces = [&](double from, double to, double& width, double& origin) {
    const int count = cells_in(from, to, options.size);
    width = (to - from) / count, origin = from;
    return count;
  };
  n_[0] =
      options.repeats ? between_faces(low.x, high.x, width_.x, origin_.x) : axis(low.x, high.x, width_.x, origin_.x);
  n_[1] =
      options.repeats ? between_faces(low.y, high.y, width_.y, origin_.y) : axis(low.y, high.y, width_.y, origin_.y);
  n_[2] = axis(low.z, high.z, width_.z, origin_.z);
  inverse_width_ = {1.0 / width_.x, 1.0 / width_.y, 1.0 / width_.z};
  // A point in a face it has come back to is in a cell, whichever way its last digit was rounded.
  if (options.repeats) inverse_width_.x *= 1.0 - 0x1p-48, inverse_width_.y *= 1.0 - 0x1p-48;
  state_.resize(static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]));
  noted_.assign(state_.size(), 0);
  for (std::uint32_t c = 0; c < state_.size(); ++c) state_[c] = kind_at_start(index_of(c));
}

AirCell AirCells::kind_at_start(const std::array<int, 3>& index) const {
  const bool plate = options_.cover_x > 0.0;
  if (!plate || origin_.z + (index[2] + 0.5) * width_.z > 0.0) return AirCell::asleep;
  const double x = origin_.x + (index[0] + 0.5) * width_.x, y = origin_.y + (index[1] + 0.5) * width_.y;
  return std::abs(x) < options_.cover_x && std::abs(y) < options_.cover_y ? AirCell::wall : AirCell::outside;
}

std::array<int, 3> AirCells::index_of(std::uint32_t cell) const {
  const int c = static_cast<int>(cell);
  return {c % n_[0], c / n_[0] % n_[1], c / (n_[0] * n_[1])};
}

Vec3 AirCells::lower_corner(std::uint32_t cell) const {
  const auto i = index_of(cell);
  return {origin_.x + i[0] * width_.x, origin_.y + i[1] * width_.y, origin_.z + i[2] * width_.z};
}

std::uint32_t AirCells::cell_of(const Vec3& point) const {
  const double x = std::floor((point.x - origin_.x) * inverse_width_.x),
               y = std::floor((point.y - origin_.y) * inverse_width_.y),
               z = std::floor((point.z - origin_.z) * inverse_width_.z);
  if (!(x >= 0.0 && x < n_[0] && y >= 0.0 && y < n_[1] && z >= 0.0 && z < n_[2])) return outside_cell;
  return static_cast<std::uint32_t>((static_cast<int>(z) * n_[1] + static_cast<int>(y)) * n_[0] + static_cast<int>(x));
}

void AirCells::disturb(const Vec3& point) {
  const std::uint32_t centre = cell_of(point);
  if (centre == outside_cell || noted_[centre] == 2) return;
  noted_[centre] = 2;  // its neighbours are noted
  noted_cells_.push_back(centre);
  const auto i = index_of(centre);
  const auto first = [&](std::size_t axis) { return repeats(axis) ? i[axis] - 1 : std::max(0, i[axis] - 1); };
  const auto last = [&](std::size_t axis) { return repeats(axis) ? i[axis] + 1 : std::min(n_[axis] - 1, i[axis] + 1); };
  const auto folded = [&](int k, std::size_t axis) { return (k + n_[axis]) % n_[axis]; };
  for (int z = first(2); z <= last(2); ++z)
    for (int y = first(1); y <= last(1); ++y)
      for (int x = first(0); x <= last(0); ++x) {
        const auto c = static_cast<std::uint32_t>((z * n_[1] + folded(y, 1)) * n_[0] + folded(x, 0));
        if (noted_[c] != 0) continue;
        noted_[c] = 1;
        noted_cells_.push_back(c);
      }
}

std::uint32_t AirCells::next_to(std::uint32_t cell, int axis, int step) const {
  const int here = index_of(cell)[static_cast<std::size_t>(axis)], count = n_[axis];
  int there = here + step;
  if (repeats(static_cast<std::size_t>(axis))) there = (there + count) % count;
  if (there < 0 || there >= count) return outside_cell;
  const int stride = axis == 0 ? 1 : axis == 1 ? n_[0] : n_[0] * n_[1];
  return static_cast<std::uint32_t>(static_cast<int>(cell) + (there - here) * stride);
}

const std::vector<std::uint32_t>& AirCells::wake() {
  woken_.clear();
  for (const std::uint32_t c : noted_cells_) {
    noted_[c] = 0;
    if (state_[c] == AirCell::asleep) woken_.push_back(c);
  }
  noted_cells_.clear();
  std::sort(woken_.begin(), woken_.end());
  for (const std::uint32_t c : woken_) state_[c] = AirCell::awake;
  awake_ += woken_.size();
  if (!woken_.empty()) renew_sources();
  return woken_;
}

void AirCells::wake_all() {
  for (std::uint32_t c = 0; c < state_.size(); ++c)
    if (state_[c] == AirCell::asleep && noted_[c] == 0) noted_[c] = 1, noted_cells_.push_back(c);
}

bool AirCells::reaches_beside_cover(std::uint32_t cell) const {
  const Vec3 low = lower_corner(cell), high = low + width_;
  return beside_cover({std::max(-low.x, high.x), 0.0, 0.0}) || beside_cover({0.0, std::max(-low.y, high.y), 0.0});
}

AirCell AirCells::beyond(std::uint32_t cell, int axis, int side) const {
  const std::uint32_t next = next_to(cell, axis, side);
  return next == outside_cell ? AirCell::outside : state_[next];
}

bool AirCells::is_source(std::uint32_t cell, int axis, int side) const {
  const bool edge = next_to(cell, axis, side) == outside_cell, mirror = options_.mirrors && axis < 2 && side < 0;
  if (edge && (mirror || options_.closed)) return false;
  const AirCell kind = beyond(cell, axis, side);
  // Through the plane of the plate air comes only beside the cover, also in a cell that its rim cuts.
  const bool rim = kind == AirCell::wall && axis == 2 && side < 0 && reaches_beside_cover(cell);
  return kind == AirCell::asleep || kind == AirCell::outside || rim;
}

void AirCells::renew_sources() {
  std::erase_if(sources_,
                [&](const AirSource& s) { return beyond(s.cell, s.axis, s.sign > 0.0 ? -1 : 1) == AirCell::awake; });
  for (const std::uint32_t c : woken_)
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1})
        if (is_source(c, axis, side)) sources_.push_back({c, axis, -static_cast<double>(side)});
}

}  // namespace standoff::particles
