#include "particle_solver/scene/sand_front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace standoff::particles {

double sand_front_radius(const SandState& sand, const Vec3& centre) {
  if (sand.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> radii;
  radii.reserve(sand.size());
  for (const Vec3& x : sand.position) radii.push_back(norm(x - centre));
  const auto index = static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(radii.size()))) - 1;
  std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(index), radii.end());
  return radii[index];
}

}  // namespace standoff::particles
