#include "particle_solver/scene/shock_arrival.hpp"

#include <algorithm>
#include <limits>

namespace standoff::particles {

ShockArrival::ShockArrival(const SandState& sand, const Vec3& centre, const SoilBody& body) : centre_(centre) {
  std::uint32_t highest_id = 0;
  for (const std::uint32_t id : sand.id) highest_id = std::max(highest_id, id);
  outermost_.assign(static_cast<std::size_t>(highest_id) + 1, 0);
  for (std::size_t i = 0; i < sand.size(); ++i)
    outermost_[sand.id[i]] = body.beyond_outside(sand.position[i]) > -4.0 * sand.radius;
}

void ShockArrival::observe(const SandState& sand, double time) {
  if (!velocities_.empty() && velocities_.back() < 0.5 * highest_) return;  // long past
  double mass = 0.0, momentum = 0.0;
  for (std::size_t i = 0; i < sand.size(); ++i) {
    if (!outermost_[sand.id[i]]) continue;
    const Vec3 arm = sand.position[i] - centre_;
    mass += sand.mass_of(i);
    momentum += sand.mass_of(i) * dot(sand.velocity[i], arm) / norm(arm);
  }
  times_.push_back(time);
  velocities_.push_back(mass > 0.0 ? momentum / mass : 0.0);
  highest_ = std::max(highest_, velocities_.back());
}

double ShockArrival::time() const {
  for (std::size_t i = 0; i < times_.size(); ++i)
    if (velocities_[i] > 0.05 * highest_) return times_[i];
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace standoff::particles
