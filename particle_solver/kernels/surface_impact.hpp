#pragma once
// Impact of a sphere on a point of a surface that answers with a finite mass.
//
// K = 1/m + W along a direction, W = sum N_a^2 / m_a diagonal by axis (an axis held by a symmetry plane answers with
// 0). Normal, Newton's restitution e:  J_n = (1 + e) max(0, -u.n) / (1/m + n.W n)            u = v_particle - v_surface
// Friction, Coulomb, after it:     J_t = min(mu J_n, |u_t| / (1/m + tau.W tau)) against the slip u_t = |u_t| tau
// A sphere that can turn gives way to J_t more easily: 1/m + a^2/I in its place there, and u is the velocity of its
// surface (grain_rotation.hpp). Source: Goldsmith, Impact (1960), ch. 2; Brach, J. Appl. Mech. 56 (1989) 133, for the
// friction limit "slip at most ends". Each of the two impulses is along the velocity it opposes and at most ends or
// mirrors it, so neither can add energy; with e = 1 and mu = 0 the energy of both bodies together is unchanged. With
// equal answers along the axes the friction leaves the normal velocity alone.
//
// m kg, W 1/kg, u m/s, e in [0, 1], mu >= 0 without unit; no stability limit, the impulse does not know the step.
#include <algorithm>
#include <cmath>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

struct SurfaceImpactLaw {
  double restitution = 0.0;  // 0: the grain stays with the surface; 1: elastic
  double friction = 0.0;     // Coulomb coefficient
};

inline double along(const Vec3& direction, const Vec3& answer) {
  return direction.x * direction.x * answer.x + direction.y * direction.y * answer.y +
         direction.z * direction.z * answer.z;
}
inline Vec3 scaled(const Vec3& answer, const Vec3& impulse) {
  return {answer.x * impulse.x, answer.y * impulse.y, answer.z * impulse.z};
}

/// Impulse [N s] on the sphere; the surface takes the opposite. Zero if they do not approach. `across`: 1/m of a sphere
/// that does not turn, else 1/m + a^2/I.
inline Vec3 surface_impulse(const SurfaceImpactLaw& law, const Vec3& relative_velocity, const Vec3& normal,
                            double particle_inverse_mass, double across, const Vec3& surface_answer) {
  const double approach = -dot(relative_velocity, normal);
  if (!(approach > 0.0)) return {};
  const double size = (1.0 + law.restitution) * approach / (particle_inverse_mass + along(normal, surface_answer));
  Vec3 impulse = normal * size;
  if (law.friction == 0.0) return impulse;
  const Vec3 after = relative_velocity + impulse * particle_inverse_mass + scaled(surface_answer, impulse);
  const Vec3 slip = after - normal * dot(after, normal);
  const double speed = norm(slip);
  if (speed == 0.0) return impulse;
  const Vec3 direction = slip / speed;
  const double stop = speed / (across + along(direction, surface_answer));
  return impulse - direction * std::min(law.friction * size, stop);
}

}  // namespace standoff::particles
