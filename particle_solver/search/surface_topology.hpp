#pragma once
// Which face of the sheet lies across which edge, what its rims are, and the rigid ring around it. Built once; motion
// does not change it.
//
//   local edges of a quad      3 --2-- 2       ring: every outer edge is extruded along the rays from the origin to the
//   (edge e: corner e to e+1)  3       1       square |x|, |y| <= half size, with nodes of its own at the mesh edge, so
//   that
//                              0 --0-- 1       what hits the ring never loads a node of the plate
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "coupling/contract/surface.hpp"

namespace standoff::particles {

/// What an edge without a neighbour is, in SurfaceTopology::neighbour.
enum SurfaceRim : std::int32_t { open_rim = -1, mirror_rim_x = -2, mirror_rim_y = -3 };

struct SurfaceTopology {
  std::vector<std::array<std::int32_t, 4>> neighbour;  // face across local edge, or a SurfaceRim
  std::vector<std::int32_t> weld;                      // node -> node it coincides with (ring onto plate), else itself
  std::vector<std::int32_t> first_face, node_face;     // faces around welded node n: node_face[first_face[n] ..)
  std::vector<std::uint8_t> on_open_rim, on_mirror_x, on_mirror_y;  // by welded node

  std::span<const std::int32_t> faces_around(std::int32_t welded) const {
    const auto n = static_cast<std::size_t>(welded);
    return {node_face.data() + first_face[n], node_face.data() + first_face[n + 1]};
  }
};

/// The plate's mesh continued by the ring; ring nodes have infinite mass.
struct RingedMesh {
  SurfaceMesh mesh;
  std::vector<std::int32_t> weld;
};

/// Throws Stop(bad_case) if a quad is out of range, an edge has three faces, or the plate does not fit in the ring.
RingedMesh add_rigid_ring(SurfaceMesh plate, bool quarter, double half_size);
SurfaceTopology surface_topology(const SurfaceMesh& mesh, std::vector<std::int32_t> weld, bool quarter);

}  // namespace standoff::particles
