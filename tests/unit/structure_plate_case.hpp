#pragma once
// The plate of the reference experiment for tests: AL-6XN, 406 mm x 406 mm x 3.4 mm [Borvik 2011, sec. 3.4, table 3].
#include <cmath>
#include <vector>

#include "structure_solver/models/plate_hex64/plate_hex64.hpp"

namespace standoff::structure::testing {

inline MaterialSpec al6xn() {
  MaterialSpec m;
  m.density = 8060.0, m.youngs_modulus = 195e9, m.poissons_ratio = 0.3;
  m.A = 410e6, m.B = 1902e6, m.n = 0.82, m.C = 0.024, m.reference_rate = 1e-3;
  m.m = 1.03, m.room_temperature = 296.0, m.melting_temperature = 1700.0;
  m.specific_heat = 500.0, m.taylor_quinney = 0.9, m.thermal_expansion = 1.5e-5;
  return m;
}

inline CaseSpec plate_case(int elements, bool quarter, double yield = 410e6) {
  CaseSpec spec;
  spec.plate.material = al6xn();
  spec.plate.material.A = yield;
  spec.plate.size = {0.406, 0.406, 0.0034};
  spec.plate.elements = {elements, elements, 1};
  spec.run.quarter_symmetry = quarter;
  for (const char* name : {"plasticity", "hardening", "strain_rate", "heating", "expansion"})
    spec.effects.push_back({name, true, "", false});
  return spec;
}

/// Starts the plate with the velocity of an impulse [N s, full plate] of the shape cos^2(theta) / d^2 of a charge 150
/// mm away, spread through the thickness.
inline void give_impulse(PlateHex64& model, double impulse) {
  const PlateMesh& mesh = model.plate().mesh();
  const double areal = mesh.options.density * mesh.options.size.z, distance = 0.15;
  std::vector<double> specific;
  double total = 0.0;
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    const Vec3& x = mesh.position[i];
    const double d2 = x.x * x.x + x.y * x.y + distance * distance;
    specific.push_back(distance * distance / (d2 * d2));
    total += mesh.mass[i] / areal * specific.back() * (mesh.options.quarter ? 4.0 : 1.0);
  }
  std::vector<double> u(static_cast<std::size_t>(model.relaxation()->dofs()), 0.0), v;
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    if ((mesh.fixed[i] & fixed_x) == 0) v.push_back(0.0);
    if ((mesh.fixed[i] & fixed_y) == 0) v.push_back(0.0);
    if ((mesh.fixed[i] & fixed_z) == 0) v.push_back(-specific[i] * impulse / total / areal);
  }
  model.relaxation()->set_state(u, v);
}

/// Forces on the surface nodes of a uniform pressure [Pa] on the loaded face.
inline std::vector<Vec3> pressure_force(const PlateMesh& mesh, double pressure) {
  std::vector<Vec3> force;
  for (const double mass : plate_surface(mesh).node_mass)
    force.push_back({0.0, 0.0, -pressure * mass / (mesh.options.density * mesh.options.size.z)});
  return force;
}

}  // namespace standoff::structure::testing
