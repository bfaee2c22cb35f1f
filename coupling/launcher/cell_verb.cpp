#include <algorithm>
#include <cstdio>
#include <fstream>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/cost_study.hpp"
#include "coupling/launcher/prediction.hpp"
#include "coupling/launcher/report_script.hpp"
#include "coupling/launcher/run_folder.hpp"
#include "coupling/launcher/run_record.hpp"
#include "coupling/launcher/text_format.hpp"
#include "coupling/launcher/verbs.hpp"
#include "coupling/output/atomic_file.hpp"

namespace standoff::launch {
namespace {

/// A folder that holds a finished test is not written again.
std::string cell_folder(const CellOptions& options, const std::string& case_name) {
  if (options.out.empty()) return numbered_folder("runs/" + file_name_of(case_name), "cell");
  if (std::ifstream(options.out + "/cell.json"))
    throw Stop(ExitCode::bad_case,
               fmt::format("{} already holds the test of a cell; choose another folder with --out", options.out));
  return named_run_folder(options.out);
}

OrderedJson read_result(const std::string& folder) {
  std::ifstream file(folder + "/cell.json");
  OrderedJson result = OrderedJson::parse(file, nullptr, false);
  if (!result.is_object()) throw Stop(ExitCode::participant_lost, folder + "/cell.json was not written");
  return result;
}

std::string facts_text(const OrderedJson& r) {
  const auto mean = [&](const char* key) { return r[key]["mean"].get<double>(); };
  return fmt::format(
      "{} sand: {} cells of {} grains, k0 {:.4g} GN/m, friction {:.3g}, damping {:.3g}{}\n"
      "  packed to {:.3g}, {:.2f} contacts a grain, overlap at most {:.2g} % of a diameter (mean over cells)\n"
      "  residual stress {:.3g} MPa axial, {:.3g} MPa lateral: subtracted below\n",
      r["kind"].get<std::string>(), r["cells"].get<long>(), r["grains"].get<long>(),
      1e-9 * r["stiffness_N_per_m"].get<double>(), r["friction"].get<double>(), r["damping"].get<double>(),
      r.value("grain_rotation", false) ? ", grains turn" : "", r["packing"].get<double>(), mean("coordination"),
      100.0 * mean("overlap_over_diameter"), 1e-6 * mean("residual_axial_Pa"), 1e-6 * mean("residual_lateral_Pa"));
}

/// At most ten rows, the last one among them.
std::string curve_text(const OrderedJson& points) {
  std::vector<std::vector<std::string>> rows{
      {"strain", "axial MPa", "lateral MPa", "lateral/axial", "secant bulk modulus GPa", "contacts"}};
  const std::size_t count = points.size(), stride = (count + 9) / 10;
  for (std::size_t n = (count - 1) % stride; n < count; n += stride) {
    const auto number = [&](const char* key) { return points[n][key].get<double>(); };
    rows.push_back({fmt::format("{:.2f} %", 100.0 * number("strain")), fmt::format("{:.1f}", 1e-6 * number("axial_Pa")),
                    fmt::format("{:.1f}", 1e-6 * number("lateral_Pa")),
                    fmt::format("{:.3f}", number("lateral_over_axial")),
                    fmt::format("{:.3f} +- {:.3f}", 1e-9 * number("secant_bulk_modulus_Pa"),
                                1e-9 * number("secant_bulk_modulus_deviation_Pa")),
                    fmt::format("{:.2f}", number("coordination"))});
  }
  return table_text(rows, {true, true, true, true, true, true});
}

}  // namespace

int cell_verb(const CellOptions& options) {
  CaseOverrides overrides = options.overrides;
  overrides.purpose = CasePurpose::cell;
  const CaseRead read = read_case(options.case_path, overrides);
  if (!print_diagnostics(read)) return static_cast<int>(ExitCode::bad_case);
  const std::string program = program_path("standoff-particles");
  const std::string folder = cell_folder(options, read.spec.name), resolved = folder + "/case.resolved.toml";
  write_atomically(resolved, read.resolved);
  const int threads = options.threads > 0 ? options.threads : usable_cores();
  const auto cause = run_to_end(
      "particles", {program, "cell", "--case", resolved, "--out", folder, "--threads", std::to_string(threads)},
      [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); });
  if (cause) throw Stop(cause->code, cause->what);
  const OrderedJson result = read_result(folder);
  const std::string trouble = run_report_script("cell_figure.py", {"--out", folder + "/cell.svg", folder});
  if (options.json)
    std::printf("%s\n", result.dump(2).c_str());
  else
    std::printf("%s%s%s/stress_strain.csv, cells.csv, cell.json%s\n", facts_text(result).c_str(),
                curve_text(result["points"]).c_str(), folder.c_str(), trouble.empty() ? ", cell.svg" : "");
  if (!trouble.empty()) std::fprintf(stderr, "warning: no figure: %s\n", trouble.c_str());
  return static_cast<int>(ExitCode::done);
}

}  // namespace standoff::launch
