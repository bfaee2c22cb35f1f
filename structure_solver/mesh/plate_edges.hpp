#pragma once
// How the edges of a plate are held, as components of nodes that do not move and as hinges.
//
//   clamped   the rim, through the thickness, in every direction
//   pinned    the rim across and along the edge; outwards it may only turn about the mid-surface:
//             u_n(z) = -u_n(-h - z), pairs of nodes mirrored at the mid-surface (Hinge). Translations of the edge are
//             held, its rotation is free: "hard" simple support that does not slide
//   free      nothing
//   symmetry  a mirror plane: the component normal to the edge, through the thickness, and so its slope; the edge
//             slides in the plane of the mirror, across the plate too. The plate goes on as its own mirror image
//   bolted    a frame on both faces: beyond its square opening the nodes of the two faces are held, metal between them
//             is not. The hole begins at the node line nearest to the edge of the opening
// A quarter holds x on x = 0 and y on y = 0 besides.
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::structure {

struct PlateMesh;

enum FixedComponent : std::uint8_t { fixed_x = 1, fixed_y = 2, fixed_z = 4, fixed_all = 7 };

/// Two nodes of equal mass whose component moves by equal and opposite amounts.
struct Hinge {
  std::int32_t lower = 0, upper = 0;
  double Vec3::*component = nullptr;
};

/// Fills mesh.fixed and mesh.hinges; throws Stop(bad_case) for edges that do not exist.
void hold_edges(PlateMesh& mesh);

/// Half width of the part that is not held, along x or y (0, 1): of the opening where there is one.
double free_half_width(const PlateMesh& mesh, int axis);

}  // namespace standoff::structure
