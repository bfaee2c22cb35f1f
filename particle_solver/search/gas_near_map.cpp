#include "particle_solver/search/gas_near_map.hpp"

#include <algorithm>
#include <cmath>

namespace standoff::particles {
namespace {

int floor_to_int(double x) {
  return static_cast<int>(std::floor(x));
}
int modulo(int i, int n) {
  const int rest = i % n;
  return rest < 0 ? rest + n : rest;
}

}  // namespace

template <bool Periodic>
GasNearMap::Cell GasNearMap::cell_of(const Vec3& point) const {
  const Vec3 per = Periodic ? per_width_ : Vec3{inverse_width_, inverse_width_, inverse_width_};
  return {floor_to_int(point.x * per.x), floor_to_int(point.y * per.y), floor_to_int(point.z * per.z)};
}

template <bool Periodic>
std::size_t GasNearMap::stored(int x, int y, int z) const {
  if constexpr (Periodic) return static_cast<std::size_t>(((z & mask_) * ny_ + modulo(y, ny_)) * nx_ + modulo(x, nx_));
  return static_cast<std::size_t>(((z & mask_) * (mask_ + 1) + (y & mask_)) * (mask_ + 1) + (x & mask_));
}

void GasNearMap::clear(std::size_t points, double reach, const Period& period) {
  // A point marks 27 cells, so 64 stored cells a point keep accidental neighbours rare; 2 MiB at most.
  int side = 16;
  while (side < 128 && static_cast<std::size_t>(side) * side * side < 64 * points) side *= 2;
  mask_ = side - 1;
  inverse_width_ = 1.0 / reach;
  const auto along = [&](double length) { return std::clamp(static_cast<int>(length / reach), 1, side); };
  nx_ = along(period.length.x), ny_ = along(period.length.y);
  per_width_ = {nx_ * period.per_length.x, ny_ * period.per_length.y, inverse_width_};
  const auto cells = static_cast<std::size_t>(side) * side * side;
  flags_.assign(cells, 0);
}

template <bool Periodic>
void GasNearMap::mark(const Vec3& point) {
  const Cell c = cell_of<Periodic>(point);
  const std::size_t own = stored<Periodic>(c.x, c.y, c.z);
  if ((flags_[own] & holds) == holds) return;
  flags_[own] = holds;
  for (int z = c.z - 1; z <= c.z + 1; ++z)
    for (int y = c.y - 1; y <= c.y + 1; ++y)
      for (int x = c.x - 1; x <= c.x + 1; ++x) flags_[stored<Periodic>(x, y, z)] |= is_near;
}
template void GasNearMap::mark<false>(const Vec3& point);
template void GasNearMap::mark<true>(const Vec3& point);

void GasNearMap::mark(std::span<const Vec3> points, double reach, const Period& period) {
  mark(
      points.size(), [&](std::size_t i) { return points[i]; }, reach, period);
}

template <bool Periodic>
bool GasNearMap::near(const Vec3& point) const {
  const Cell c = cell_of<Periodic>(point);
  return flags_[stored<Periodic>(c.x, c.y, c.z)] != 0;
}
template bool GasNearMap::near<false>(const Vec3& point) const;
template bool GasNearMap::near<true>(const Vec3& point) const;

}  // namespace standoff::particles
