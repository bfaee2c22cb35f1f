#include "particle_solver/search/gas_near_map.hpp"

#include <cmath>

namespace standoff::particles {

GasNearMap::Cell GasNearMap::cell_of(const Vec3& point) const {
  const auto floor_to_int = [](double x) { return static_cast<int>(std::floor(x)); };
  return {floor_to_int(point.x * inverse_width_), floor_to_int(point.y * inverse_width_),
          floor_to_int(point.z * inverse_width_)};
}

void GasNearMap::clear(std::size_t points, double reach) {
  // A point marks 27 cells, so 64 stored cells a point keep accidental neighbours rare; 2 MiB at most.
  int side = 16;
  while (side < 128 && static_cast<std::size_t>(side) * side * side < 64 * points) side *= 2;
  mask_ = side - 1;
  inverse_width_ = 1.0 / reach;
  const auto cells = static_cast<std::size_t>(side) * side * side;
  flags_.assign(cells, 0);
}

void GasNearMap::mark(const Vec3& point) {
  const Cell c = cell_of(point);
  if ((flags_[stored(c.x, c.y, c.z)] & holds) == holds) return;
  flags_[stored(c.x, c.y, c.z)] = holds;
  for (int z = c.z - 1; z <= c.z + 1; ++z)
    for (int y = c.y - 1; y <= c.y + 1; ++y)
      for (int x = c.x - 1; x <= c.x + 1; ++x) flags_[stored(x, y, z)] |= is_near;
}

void GasNearMap::mark(std::span<const Vec3> points, double reach) {
  mark(
      points.size(), [&](std::size_t i) { return points[i]; }, reach);
}

bool GasNearMap::near(const Vec3& point) const {
  const Cell c = cell_of(point);
  return flags_[stored(c.x, c.y, c.z)] != 0;
}

}  // namespace standoff::particles
