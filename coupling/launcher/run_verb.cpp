#include <filesystem>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/structural_models.hpp"
#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/point_run.hpp"
#include "coupling/launcher/run_folder.hpp"
#include "coupling/launcher/run_session.hpp"
#include "coupling/launcher/verbs.hpp"
#include "coupling/tape/tape_reader.hpp"

namespace standoff::launch {

int run_verb(const RunOptions& options) {
  const CaseRead read = read_case(options.case_path, options.overrides);
  if (!print_diagnostics(read)) return static_cast<int>(ExitCode::bad_case);
  for (const std::string& tape : {options.structure_tape, options.particle_tape})
    if (!tape.empty()) TapeReader reader(tape);  // says at once if it is none
  for (const char* name : {"standoff-broker", "standoff-structure", "standoff-particles"}) program_path(name);
  const std::string folder =
      options.out.empty() ? new_run_folder("runs", read.spec.name, read.spec.level) : named_run_folder(options.out);
  if (read.spec.plate.model == material_point_model) return run_point(options, read, folder);
  RunSession session(options, read, folder);
  return session.run();
}

}  // namespace standoff::launch
