#include "particle_solver/search/gas_near_map.hpp"

#include <cmath>

namespace standoff::particles {

GasNearMap::Cell GasNearMap::cell_of(const Vec3& point) const {
  const auto floor_to_int = [](double x) { return static_cast<int>(std::floor(x)); };
  return {floor_to_int(point.x * inverse_width_), floor_to_int(point.y * inverse_width_),
          floor_to_int(point.z * inverse_width_)};
}

void GasNearMap::mark(std::span<const Vec3> points, double reach) {
  // A point marks 27 cells, so 64 stored cells a point keep accidental neighbours rare; 4 MiB at most.
  int side = 16;
  while (side < 128 && static_cast<std::size_t>(side) * side * side < 64 * points.size()) side *= 2;
  mask_ = side - 1;
  inverse_width_ = 1.0 / reach;
  const auto cells = static_cast<std::size_t>(side) * side * side;
  holds_.assign(cells, 0);
  near_.assign(cells, 0);
  for (const Vec3& point : points) {
    const Cell c = cell_of(point);
    std::uint8_t& holds = holds_[stored(c.x, c.y, c.z)];
    if (holds != 0) continue;
    holds = 1;
    for (int z = c.z - 1; z <= c.z + 1; ++z)
      for (int y = c.y - 1; y <= c.y + 1; ++y)
        for (int x = c.x - 1; x <= c.x + 1; ++x) near_[stored(x, y, z)] = 1;
  }
}

bool GasNearMap::near(const Vec3& point) const {
  const Cell c = cell_of(point);
  return near_[stored(c.x, c.y, c.z)] != 0;
}

}  // namespace standoff::particles
