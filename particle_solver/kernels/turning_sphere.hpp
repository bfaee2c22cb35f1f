#pragma once
// A sphere that something touches: how its surface moves, and how it gives way to an impulse. Two kinds with the same
// functions, one for scenes in which grains do not turn.
//
//   surface   u = v - a w x n,  n towards the sphere's centre, a from there to the point of contact; 0 if it is behind
//   impulse J on it:  v += J/m,  w += a J x n / I,  u += J/m + a^2/I (J - (n.J) n)
//   I = 2/5 m r^2, a solid sphere; a = r and J along the tangent: u changes by 7/2 J/m
// Source: e.g. Brach, J. Appl. Mech. 56 (1989) 133; Goldsmith, Impact (1960), ch. 2. Deviation: a is the distance of
// the point that is touched, not the radius, so that the angular momentum about that point is exact.
//
// m kg, r and a m, v m/s, w rad/s, I kg m^2, J N s. No limit of stability: nothing is integrated here.
#include <algorithm>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

inline double moment_of_inertia(double mass, double radius) {
  return 0.4 * mass * radius * radius;
}

/// A sphere on the sheet that does not turn: its surface moves as its centre.
struct SmoothSphere {
  double mass;
  Vec3& velocity;

  Vec3 surface_velocity(const Vec3&) const { return velocity; }
  double inverse_mass() const { return 1.0 / mass; }
  /// 1/kg along the tangent.
  double across() const { return 1.0 / mass; }
  double mass_across() const { return mass; }
  /// Change of the surface's velocity by an impulse.
  Vec3 change(const Vec3& impulse, const Vec3&) const { return impulse * (1.0 / mass); }
  void push(const Vec3& force, double time, const Vec3&) { velocity += force * (time / mass); }
};

/// A sphere on the sheet that turns.
struct TurningSphere {
  TurningSphere(double sphere_mass, double radius, double distance, Vec3& sphere_velocity, Vec3& sphere_spin)
      : mass(sphere_mass),
        lever(std::max(0.0, distance)),
        moment(moment_of_inertia(sphere_mass, radius)),
        velocity(sphere_velocity),
        spin(sphere_spin) {}
  double mass, lever, moment;
  Vec3 &velocity, &spin;

  Vec3 surface_velocity(const Vec3& normal) const { return velocity - cross(spin, normal) * lever; }
  double inverse_mass() const { return 1.0 / mass; }
  double across() const { return 1.0 / mass + lever * lever / moment; }
  double mass_across() const { return 1.0 / across(); }
  Vec3 change(const Vec3& impulse, const Vec3& normal) const {
    return impulse * (1.0 / mass) + (impulse - normal * dot(impulse, normal)) * (lever * lever / moment);
  }
  void push(const Vec3& force, double time, const Vec3& normal) {
    velocity += force * (time / mass), spin += cross(force, normal) * (time * lever / moment);
  }
};

}  // namespace standoff::particles
