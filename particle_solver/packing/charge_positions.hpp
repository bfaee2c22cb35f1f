#pragma once
// Centres of equal spheres in a ball or a cylinder about z, or in its quarter x >= 0, y >= 0, without overlaps.
//
// 1. A low-discrepancy sequence (additive recurrence with the powers of 1/g, g^4 = g + 1), shifted at random and
// jittered by a third of the spacing, mapped to equal volumes of the body.
// 2. Overlap relaxation: every sphere moves by the sum of half of its overlaps, centres stay in the body (spheres of a
// cylinder stay within its radius whole, as its casing asks, and lie the closer: by 2 r/R at most), until nothing
// overlaps. Spheres are 1 % too large meanwhile, so that "nothing" is reached in a finite number of sweeps. Fluid fills
// (<= 0.45) need some tens of sweeps; the packing limit is 0.64.
// 3. A quarter is cut from a whole body of four times the number, turned about z so that it holds exactly its share.
// So it is as dense at its mirror planes as anywhere: packed between them, spheres would line up along the planes, and
// a layer of half spheres there holds back the products less than explosive does.
// The result is in cell order: neighbours in the list are neighbours in space.
#include <cstdint>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

struct ChargePositions {
  std::size_t count = 0;              // in the quarter, if it is one
  double radius = 0.0, length = 0.0;  // m, of the body; length 0: a ball
  double sphere_radius = 0.0;         // m
  bool quarter = false;
  std::uint64_t seed = 1;
};

/// Centres relative to the centre of the body [m].
std::vector<Vec3> charge_positions(const ChargePositions& wanted);

}  // namespace standoff::particles
