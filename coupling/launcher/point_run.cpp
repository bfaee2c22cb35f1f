#include "coupling/launcher/point_run.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "coupling/base/stage_timer.hpp"
#include "coupling/base/stop.hpp"
#include "coupling/launcher/build_facts.hpp"
#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/cost_study.hpp"
#include "coupling/launcher/report_script.hpp"
#include "coupling/launcher/run_record.hpp"
#include "coupling/output/atomic_file.hpp"

namespace standoff::launch {

int run_point(const RunOptions& options, const CaseRead& read, const std::string& folder) {
  const Stopwatch wall;
  const std::string resolved = folder + "/case.resolved.toml";
  write_atomically(resolved, read.resolved);
  const auto cause =
      run_to_end("structure", {program_path("standoff-structure"), "point", "--case", resolved, "--out", folder},
                 [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); });
  const ExitCode code = cause ? cause->code : ExitCode::done;
  OrderedJson record;
  record["status"] = !cause ? "done" : code == ExitCode::interrupted ? "interrupted" : "failed";
  record["exit_code"] = static_cast<int>(code);
  record["reason"] = cause ? cause->what : "";
  record["case"] = read.spec.name;
  record["structure_model"] = read.spec.plate.model;
  record["timing"]["wall_s"] = wall.seconds();
  record["provenance"] = {{"version", build_facts().version}, {"git", build_facts().git}, {"case_hash", read.hash}};
  write_atomically(folder + "/run.json", record.dump(2) + "\n");
  if (cause) throw Stop(code, cause->what);
  const std::string trouble = run_report_script("flow_figure.py", {folder});
  if (!trouble.empty()) std::fprintf(stderr, "standoff: warning: no figure: %s\n", trouble.c_str());
  if (!options.quiet)
    std::printf("flow curves of %s: %s/flow_curves.csv%s\n", read.spec.plate.material.name.c_str(), folder.c_str(),
                trouble.empty() ? ", flow_curves.svg" : "");
  return static_cast<int>(code);
}

}  // namespace standoff::launch
