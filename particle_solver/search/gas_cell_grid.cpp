#include "particle_solver/search/gas_cell_grid.hpp"

#include <algorithm>
#include <bit>

namespace standoff::particles {

void GasCellGrid::shape(std::size_t count, double reach, double periodic_side) {
  periodic_ = periodic_side > 0.0;
  // Rows are as wide as the reach, so a search meets 9 to 16 of them; along a row, where cells cost nothing, half of
  // that clips the candidates closer.
  if (periodic_) {
    const auto cells = [&](double width) { return std::clamp(static_cast<int>(periodic_side / width), 1, 1024); };
    nx_ = cells(0.5 * reach), ny_ = nz_ = cells(reach);
    width_ = {periodic_side / nx_, periodic_side / ny_, periodic_side / nz_};
  } else {
    const int bits = std::bit_width(std::clamp<std::size_t>(4 * count, 512, std::size_t{1} << 24));
    nx_ = 1 << (bits - 2 * (bits / 3)), ny_ = nz_ = 1 << (bits / 3);
    width_ = {0.5 * reach, reach, reach};
  }
  inverse_width_ = {1.0 / width_.x, 1.0 / width_.y, 1.0 / width_.z};
}

std::uint32_t GasCellGrid::stored_cell(const Vec3& point) const {
  const int x = floor_to_int(point.x * inverse_width_.x), y = floor_to_int(point.y * inverse_width_.y),
            z = floor_to_int(point.z * inverse_width_.z);
  if (periodic_) return static_cast<std::uint32_t>((modulo(z, nz_) * ny_ + modulo(y, ny_)) * nx_ + modulo(x, nx_));
  return static_cast<std::uint32_t>((fold<false>(z, nz_) * ny_ + fold<false>(y, ny_)) * nx_ + fold<false>(x, nx_));
}

void GasCellGrid::sort(std::span<const Vec3> points) {
  const auto cells = static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) * static_cast<std::size_t>(nz_);
  start_.assign(cells + 1, 0);
  cell_.resize(points.size());
  order_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    cell_[i] = stored_cell(points[i]);
    ++start_[cell_[i]];
  }
  // start_[c] becomes the end of cell c, and walking backwards turns ends into starts: stable, no second array.
  std::uint32_t sum = 0;
  for (std::uint32_t& s : start_) s = sum += s;
  for (std::size_t i = points.size(); i-- > 0;) order_[--start_[cell_[i]]] = static_cast<std::uint32_t>(i);
}

}  // namespace standoff::particles
