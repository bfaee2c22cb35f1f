#include "particle_solver/step/surface_carry.hpp"

#include <algorithm>

namespace standoff::particles {

void surface_carry(GasState& gas, const SurfaceSheet& sheet, int threads, CarriedGas& carried) {
  if (!(sheet.jump() > 0.0)) return;
  const double deepest = gas.radius + sheet.jump();
  const auto size = static_cast<std::ptrdiff_t>(gas.size());
  long count = 0;
  std::ptrdiff_t last = -1;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(+ : count) reduction(max : last) if (size > 4096)
  for (std::ptrdiff_t k = 0; k < size; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!gas.released.empty() && gas.released[i] == 0) continue;
    Vec3& x = gas.position[i];
    const SheetPoint where = sheet.closest(x, deepest);
    if (where.face < 0 || where.gap >= -gas.radius || where.gap < -deepest) continue;
    x -= where.normal * where.gap;
    ++count, last = std::max(last, k);
  }
  carried.particles += count;
  if (last >= 0) carried.last = gas.position[static_cast<std::size_t>(last)];
}

}  // namespace standoff::particles
