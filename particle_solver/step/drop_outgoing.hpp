#pragma once
// Stage drop_outgoing: names the grains that can no longer reach the plate, for `boundaries` to take out and book.
//
// A grain is named when (1) it has left the body: farther from the charge than any grain began, and moving away; (2) no
// contact force acts on it; and (3) its free flight misses plate and cover (kernels/free_flight.hpp), and so does what
// flies behind it straight from the charge, so that grains thrown back from the plate are kept. Exact for grains
// that nothing overtakes; what products behind would still give to a grain that flies past the plate is left out.
#include <cstdint>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

class DropOutgoing {
 public:
  /// Measures the body as it stands at the start.
  DropOutgoing(const SandState& sand, const Vec3& centre);
  /// Indices, ascending; valid until the next call.
  const std::vector<std::uint32_t>& find(const SandState& sand, const SurfaceSheet& sheet);

 private:
  Vec3 centre_;
  double body_radius_ = 0.0;  // m
  std::vector<std::uint32_t> out_;
};

}  // namespace standoff::particles
