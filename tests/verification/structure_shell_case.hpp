#pragma once
// The plate of the reference experiment as shells, for tests.
#include "structure_solver/models/plate_shell/plate_shell.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure::testing {

inline CaseSpec shell_case(int elements, bool quarter, double yield = 410e6, const char* edges = "clamped") {
  CaseSpec spec = plate_case(elements, quarter, yield);
  spec.plate.model = "plate_shell";
  spec.plate.edges = edges;
  return spec;
}

/// Starts the plate with the velocity of an impulse [N s, full plate] of the shape of give_impulse(PlateHex64&).
inline void give_impulse(PlateShell& model, double impulse) {
  const ShellMesh& mesh = model.plate().mesh();
  const double areal = mesh.options.density * mesh.options.size.z, distance = 0.15;
  ShellPlate::Nodal rest{std::vector<Vec3>(mesh.node_count()), std::vector<Vec3>(mesh.node_count())}, velocity = rest;
  double total = 0.0;
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    const Vec3& x = mesh.position[i];
    const double d2 = x.x * x.x + x.y * x.y + distance * distance, specific = distance * distance / (d2 * d2);
    total += mesh.mass[i] / areal * specific * (mesh.options.quarter ? 4.0 : 1.0);
    if ((mesh.fixed[i] & fixed_z) == 0) velocity.u[i].z = -specific;
  }
  for (Vec3& v : velocity.u) v.z *= impulse / total / areal;
  model.plate().set_motion(rest, velocity);
}

/// A rotation by `angle` about an axis of unit length: Rodrigues' formula.
inline Vec3 rotated(const Vec3& x, const Vec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * x + s * cross(axis, x) + (1.0 - c) * dot(axis, x) * axis;
}

/// The slip whose director is d: the inverse of director_lean for |t| < pi.
inline Vec3 slip_of(const Vec3& d, double half_thickness) {
  const double across = std::hypot(d.x, d.y), angle = std::atan2(across, d.z);
  if (across == 0.0) return {};
  return half_thickness * angle / across * Vec3{d.x, d.y, 0.0};
}

}  // namespace standoff::structure::testing
