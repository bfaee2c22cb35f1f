#pragma once
// A unit cell of sand: spheres packed at random in a periodic cube of edge 1 [Borvik 2011, sec. 3.3].
//
// Random centres, full radii, then overlaps are relaxed without friction (relaxation.hpp). A fill of 0.60 becomes free
// of overlap; 0.64 is random close packing, where a small overlap stays. It is a property of the material and is
// reported: in a body with free surfaces it relaxes (sand_body.hpp), in a periodic cell its pressure must be
// subtracted.
#include <cstdint>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

struct PackedCellOptions {
  int count = 1000;
  double fill = 0.60;          // volume of the spheres over volume of the cell
  double radius_spread = 0.0;  // radii are uniform in mean (1 -/+ spread)
  std::uint64_t seed = 1;
  friend auto operator<=>(const PackedCellOptions&, const PackedCellOptions&) = default;
};

struct PackedCell {
  std::vector<Vec3> position;  // in [0, 1)
  std::vector<double> radius;  // empty when all are equal
  double mean_radius = 0.0;
  double max_overlap = 0.0;        // in mean diameters
  double coordination = 0.0;       // mean number of contacts of a grain
  double residual_pressure = 0.0;  // Pa for k0 = 1 N/m: multiply by k0
  int iterations = 0;
};

/// Packs, or returns the cell packed before with the same options, by this process or by this program (cell_cache.hpp).
const PackedCell& pack_cell(const PackedCellOptions& options);

}  // namespace standoff::particles
