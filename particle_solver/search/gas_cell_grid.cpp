#include "particle_solver/search/gas_cell_grid.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace standoff::particles {

void GasCellGrid::shape(std::size_t count, double reach, const Period& period) {
  periodic_ = period.on();
  // Rows are as wide as the reach, so a search meets 9 to 16 of them; along a row, where cells cost nothing, half of
  // that clips the candidates closer.
  if (periodic_) {
    const auto cells = [](double length, double width) {
      return std::clamp(static_cast<int>(length / width), 1, 1024);
    };
    const int most = static_cast<int>(std::min<std::size_t>(16 * count + 4096, 1 << 22));  // beside each other
    const Vec3& length = period.length;
    double wide = reach;
    do nx_ = cells(length.x, 0.5 * wide), ny_ = cells(length.y, wide), wide *= 2.0;
    while (nx_ * ny_ > most);
    nz_ = length.z > 0.0 ? cells(length.z, reach) : std::clamp(most / (nx_ * ny_), 4, 1024);
    width_ = {length.x / nx_, length.y / ny_, length.z > 0.0 ? length.z / nz_ : reach};
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

namespace {

/// Numbers of the sixteen cells of a row.
using Row = std::uint8_t __attribute__((vector_size(16)));

/// behind[c]: one in every cell behind cell c.
const auto behind = [] {
  std::array<Row, 16> table{};
  for (int c = 0; c < 16; ++c) {
    Row row{};
    for (int other = 0; other < 16; ++other) row[other] = other > c ? 1 : 0;
    table[static_cast<std::size_t>(c)] = row;
  }
  return table;
}();

/// The same for a row whose points a byte cannot count.
std::array<std::uint32_t, 16> starts_in_row(std::span<const std::uint32_t> points, std::span<const std::uint32_t> cell,
                                            std::uint32_t begin) {
  std::array<std::uint32_t, 16> count{}, start;
  for (const std::uint32_t i : points) ++count[cell[i] % 16];
  for (std::size_t c = 0; c < 16; begin += count[c++]) start[c] = begin;
  return start;
}

}  // namespace

void GasCellGrid::start_counting(std::size_t points) {
  const auto cells = static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_) * static_cast<std::size_t>(nz_);
  row_start_.assign(cells / cells_a_row + 2, 0);
  before_.assign((cells / cells_a_row + 1) * cells_a_row, 0);
  order_.resize(points);
  full_.clear();
}

/// Stable: first by rows, where row_start_ counts, becomes the ends of the rows, and walking backwards turns ends into
/// starts; then within each row.
void GasCellGrid::sort_by(std::span<const std::uint32_t> cell) {
  std::uint32_t sum = 0;
  for (std::uint32_t& s : row_start_) s = sum += s;
  for (std::size_t i = cell.size(); i-- > 0;)
    order_[--row_start_[cell[i] / cells_a_row]] = static_cast<std::uint32_t>(i);

  std::vector<std::uint32_t> unsorted;
  const std::size_t rows = row_start_.size() - 1;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint32_t begin = row_start_[row], end = row_start_[row + 1];
    if (begin == end) continue;
    Row before{};
    for (std::uint32_t p = begin; p < end; ++p) before += behind[cell[order_[p]] % cells_a_row];
    std::memcpy(&before_[row * cells_a_row], &before, sizeof(before));
    if (end - begin > 0xFF && full_.empty()) full_.resize(before_.size() + 1);
    if (end - begin == 1) continue;
    unsorted.assign(order_.begin() + begin, order_.begin() + end);
    std::array<std::uint32_t, cells_a_row> next;
    if (end - begin <= 0xFF)
      for (std::size_t c = 0; c < cells_a_row; ++c) next[c] = begin + before[c];
    else
      next = starts_in_row(unsorted, cell, begin);
    for (const std::uint32_t i : unsorted) order_[next[cell[i] % cells_a_row]++] = i;
  }
  if (full_.empty()) return;
  for (const std::uint32_t c : cell) ++full_[c + 1];
  for (std::size_t c = 0; c + 1 < full_.size(); ++c) full_[c + 1] += full_[c];
}

void GasCellGrid::sort(std::span<const Vec3> points) {
  std::vector<std::uint32_t> cell(points.size());
  sort(
      points.size(), [&](std::size_t i) { return points[i]; }, cell);
}

}  // namespace standoff::particles
