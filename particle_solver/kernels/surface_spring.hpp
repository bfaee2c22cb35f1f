#pragma once
// The soil's own contact law between a grain and the surface: a linear spring and a dashpot along the normal that never
// pull, with Coulomb friction without memory of earlier slip.
//
//   f_n = max(0, k (r - gap) - c u_n),  c = 2 xi sqrt(k m)              [Borvik 2011, sec. 3.3, grain against grain]
//   f_t = min(mu f_n, m_t |u_t| / h) against the slip u_t: at most what stops it within the step
// m_t = m, or 1 / (1/m + a^2/I) of a sphere that can turn, whose surface moves with u (grain_rotation.hpp).
// Deviation: the law between two grains has a spring along the tangent; the sheet keeps no history for it, so a grain
// held by friction creeps. The case asks for this law only as a sensitivity.
//
// k N/m, c N s/m, xi fraction of critical >= 0, u = v_grain - v_surface m/s, h s. Stable for h < 2 sqrt(m / k) with the
// lighter of grain and wall; 0.05 of it resolves the contact.
#include <algorithm>
#include <cmath>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

struct SurfaceSpringLaw {
  double stiffness = 0.0;  // N/m
  double damping = 0.0;    // fraction of critical
  double friction = 0.0;   // Coulomb coefficient
};

/// Force [N] on the grain; the surface takes the opposite.
inline Vec3 surface_spring_force(const SurfaceSpringLaw& law, double overlap, const Vec3& relative_velocity,
                                 const Vec3& normal, double mass, double mass_across, double step) {
  const double normal_speed = dot(relative_velocity, normal);
  const double damping = 2.0 * law.damping * std::sqrt(law.stiffness * mass);
  const double size = std::max(0.0, law.stiffness * overlap - damping * normal_speed);
  Vec3 force = normal * size;
  if (law.friction == 0.0) return force;
  const Vec3 slip = relative_velocity - normal * normal_speed;
  const double speed = norm(slip);
  if (speed > 0.0) force -= slip * (std::min(law.friction * size, mass_across * speed / step) / speed);
  return force;
}

}  // namespace standoff::particles
