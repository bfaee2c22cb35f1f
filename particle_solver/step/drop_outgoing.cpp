#include "particle_solver/step/drop_outgoing.hpp"

#include <algorithm>
#include <cmath>

#include "particle_solver/kernels/free_flight.hpp"

namespace standoff::particles {
namespace {

/// The surface at its highest, now or at rest: a plate that has receded may swing back to where it was.
SurfaceReach reach_of(const SurfaceSheet& sheet) {
  SurfaceReach reach;
  reach.top = sheet.highest(0.0);
  for (const Vec3& x : sheet.mesh().position) {
    reach.top = std::max(reach.top, x.z);
    reach.half_x = std::max(reach.half_x, std::abs(x.x));
    reach.half_y = std::max(reach.half_y, std::abs(x.y));
  }
  return reach;
}

}  // namespace

DropOutgoing::DropOutgoing(const SandState& sand, const Vec3& centre) : centre_(centre) {
  for (std::size_t i = 0; i < sand.size(); ++i)
    body_radius_ = std::max(body_radius_, norm(sand.position[i] - centre) + sand.radius_of(i));
}

const std::vector<std::uint32_t>& DropOutgoing::find(const SandState& sand, const SurfaceSheet& sheet) {
  const SurfaceReach surface = reach_of(sheet);
  out_.clear();
  for (std::size_t i = 0; i < sand.size(); ++i) {
    const Vec3 arm = sand.position[i] - centre_;
    if (squared_norm(arm) < body_radius_ * body_radius_ || dot(arm, sand.velocity[i]) <= 0.0) continue;
    const double radius = sand.radius_of(i);
    if (sand.force[i] == Vec3{} && passes_the_surface(centre_, arm, radius, surface) &&
        passes_the_surface(sand.position[i], sand.velocity[i], radius, surface))
      out_.push_back(static_cast<std::uint32_t>(i));
  }
  return out_;
}

}  // namespace standoff::particles
