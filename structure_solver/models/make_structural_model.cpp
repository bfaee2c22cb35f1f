#include "coupling/base/stop.hpp"
#include "coupling/case/near_word.hpp"
#include "structure_solver/models/pipe_hex64/pipe_hex64.hpp"
#include "structure_solver/models/plate_hex27/plate_hex27.hpp"
#include "structure_solver/models/plate_hex64/plate_hex64.hpp"
#include "structure_solver/models/plate_hex8/plate_hex8.hpp"
#include "structure_solver/models/plate_shell/plate_shell.hpp"
#include "structure_solver/models/rigid_plate/rigid_plate.hpp"
#include "structure_solver/models/single_dof/single_dof.hpp"

namespace standoff::structure {
namespace {

using Make = std::unique_ptr<StructuralModel> (*)(const CaseSpec&, int threads);
struct Entry {
  const char* name;
  Make make;
};

constexpr Entry registry[] = {
    {"plate_hex64",
     [](const CaseSpec& spec, int threads) -> std::unique_ptr<StructuralModel> {
       return std::make_unique<PlateHex64>(spec, threads);
     }},
    {"plate_hex27",
     [](const CaseSpec& spec, int threads) -> std::unique_ptr<StructuralModel> {
       return std::make_unique<PlateHex27>(spec, threads);
     }},
    {"plate_hex8",
     [](const CaseSpec& spec, int threads) -> std::unique_ptr<StructuralModel> {
       return std::make_unique<PlateHex8>(spec, threads);
     }},
    {"plate_shell",
     [](const CaseSpec& spec, int threads) -> std::unique_ptr<StructuralModel> {
       return std::make_unique<PlateShell>(spec, threads);
     }},
    {"rigid_plate",
     [](const CaseSpec& spec, int) -> std::unique_ptr<StructuralModel> { return std::make_unique<RigidPlate>(spec); }},
    {"pipe_hex64",
     [](const CaseSpec& spec, int threads) -> std::unique_ptr<StructuralModel> {
       return std::make_unique<PipeHex64>(spec, threads);
     }},
    {"single_dof",
     [](const CaseSpec& spec, int) -> std::unique_ptr<StructuralModel> { return std::make_unique<SingleDof>(spec); }},
};

}  // namespace

std::vector<std::string> structural_model_names() {
  std::vector<std::string> names;
  for (const Entry& entry : registry) names.emplace_back(entry.name);
  return names;
}

std::unique_ptr<StructuralModel> make_structural_model(const CaseSpec& spec, int threads) {
  for (const Entry& entry : registry)
    if (spec.plate.model == entry.name) return entry.make(spec, threads);
  throw Stop(ExitCode::bad_case, "plate.model = \"" + spec.plate.model + "\" does not exist\n  " +
                                     did_you_mean(spec.plate.model, structural_model_names(), "models"));
}

}  // namespace standoff::structure
