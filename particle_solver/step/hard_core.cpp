#include "particle_solver/step/hard_core.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle_solver/kernels/hard_core.hpp"

namespace standoff::particles {
namespace {

/// A grain against its own image: its velocity across the plane turns round. Returns the impulse on the plane.
double bounce(double& across, double mass) {
  if (!(across < 0.0)) return 0.0;
  const double impulse = 2.0 * mass * across;
  across = -across;
  return impulse;
}

}  // namespace

HardCoreCounts HardCore::run(SandState& sand, SandPairs& pairs) {
  HardCoreCounts counts;
  pairs.deep_contacts(hard_core_share, contacts_);
  for (const DeepContact& contact : contacts_) {
    const std::size_t i = contact.i, j = contact.j;
    const double mass = sand.mass_of(i);
    if (contact.with != DeepContact::With::grain) {
      const bool x = contact.with == DeepContact::With::image_x;
      const double impulse = bounce(x ? sand.velocity[i].x : sand.velocity[i].y, mass);
      (x ? counts.mirror_impulse.x : counts.mirror_impulse.y) += impulse;
      counts.hits += impulse != 0.0;
      continue;
    }
    const double other = sand.mass_of(j);
    const Vec3 impulse =
        hard_core_impulse(contact.apart, sand.velocity[i] - sand.velocity[j], 1.0 / mass + 1.0 / other);
    if (impulse == Vec3{}) continue;
    sand.velocity[i] += impulse / mass, sand.velocity[j] -= impulse / other;
    ++counts.hits;
  }
  return counts;
}

double HardCore::longest_step(const SandState& sand) {
  double fastest = 0.0, smallest = sand.radius;
  for (const Vec3& v : sand.velocity) fastest = std::max(fastest, squared_norm(v));
  for (const double r : sand.grain_radius) smallest = std::min(smallest, r);
  return fastest > 0.0 ? 0.5 * smallest / std::sqrt(fastest) : std::numeric_limits<double>::infinity();
}

}  // namespace standoff::particles
