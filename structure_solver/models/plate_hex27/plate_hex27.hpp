#pragma once
// Model "plate_hex27": the plate of plate_hex64 with quadratic hexahedra of 27 nodes and 3 x 3 x 3 Gauss points.
#include "structure_solver/models/plate_hex64/plate_hex64.hpp"

namespace standoff::structure {

class PlateHex27 final : public PlateHex64 {
 public:
  PlateHex27(const CaseSpec& spec, int threads);
};

}  // namespace standoff::structure
