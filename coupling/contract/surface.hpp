#pragma once
// What crosses the interface, in C++: the wetted surface, its motion and the load on it. Units SI, frame of the case:
// origin at the centre of the loaded face, z towards the charge.
#include <array>
#include <cstdint>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff {

/// The wetted surface as bilinear quads, offered once by the structure. Quads are ordered so that the right-hand normal
/// points to the loaded side (+z for a flat plate). node_mass [kg]: inertia that answers an impulse at the node within
/// one window, such that a hit with bilinear weights w meets the mass 1 / sum(w_a^2 / node_mass_a).
struct SurfaceMesh {
  std::vector<Vec3> position;                      // n_nodes, at rest
  std::vector<std::array<std::int32_t, 4>> quads;  // n_quads, node indices
  std::vector<double> node_mass;                   // n_nodes
};

/// Positions [m] and velocities [m/s] of the surface nodes at the end of a window.
struct SurfaceMotion {
  std::vector<Vec3> position, velocity;  // n_nodes each
};

/// Window-averaged nodal forces [N] on the structure: accumulated impulse over window length, so momentum is exact at
/// any sub-cycling ratio.
struct SurfaceLoad {
  std::vector<Vec3> force;  // n_nodes
};

}  // namespace standoff
