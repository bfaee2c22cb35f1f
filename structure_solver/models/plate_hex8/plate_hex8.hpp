#pragma once
// Model "plate_hex8": the plate of plate_hex64 with 8-node hexahedra that bend (elements/hex8.hpp), several to each
// element of plate.elements.
#include "structure_solver/models/plate_hex64/plate_hex64.hpp"

namespace standoff::structure {

class PlateHex8 final : public PlateHex64 {
 public:
  /// An element of plate.elements is cut into so many along x and along y: one for each quad that a cubic element
  /// shows.
  static constexpr int cuts = 3;
  PlateHex8(const CaseSpec& spec, int threads);
};

}  // namespace standoff::structure
