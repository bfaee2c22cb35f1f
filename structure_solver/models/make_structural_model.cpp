#include "coupling/base/stop.hpp"
#include "structure_solver/models/plate_hex64.hpp"
#include "structure_solver/models/rigid_plate.hpp"

namespace standoff::structure {

std::unique_ptr<StructuralModel> make_structural_model(const CaseSpec& spec, int threads) {
  const std::string& name = spec.plate.model;
  if (name == "plate_hex64") return std::make_unique<PlateHex64>(spec, threads);
  if (name == "rigid_plate") return std::make_unique<RigidPlate>(spec);
  throw Stop(ExitCode::bad_case,
             "plate.model = \"" + name + "\" does not exist\n  models here: plate_hex64, rigid_plate");
}

}  // namespace standoff::structure
