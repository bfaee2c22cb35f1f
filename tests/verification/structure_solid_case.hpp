#pragma once
// The solid plates beside plate_hex64, by name.
#include <memory>
#include <string>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure::testing {

inline std::unique_ptr<PlateHex64> solid_plate(const std::string& model, int elements, bool quarter, int threads = 1,
                                               const char* edges = "clamped") {
  CaseSpec spec = plate_case(elements, quarter);
  spec.plate.model = model, spec.plate.edges = edges;
  return std::unique_ptr<PlateHex64>(dynamic_cast<PlateHex64*>(make_structural_model(spec, threads).release()));
}

}  // namespace standoff::structure::testing
