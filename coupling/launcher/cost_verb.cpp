#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "coupling/base/state_hash.hpp"
#include "coupling/base/stop.hpp"
#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/cost_study.hpp"
#include "coupling/launcher/effect_study.hpp"
#include "coupling/launcher/report_script.hpp"
#include "coupling/launcher/run_folder.hpp"
#include "coupling/launcher/stage_costs.hpp"
#include "coupling/launcher/text_format.hpp"
#include "coupling/output/atomic_file.hpp"

namespace standoff::launch {
namespace {

namespace files = std::filesystem;

/// What makes two studies the same: then an interrupted one is continued.
std::string study_key(const CostStudy& study) {
  StateHash hash;
  for (const PlannedRun& run : study.runs) hash.add(std::string_view(run.case_hash));
  return hash.hex();
}

void write_state(const std::string& folder, const CostStudy& study, const char* status) {
  const nlohmann::json state{
      {"status", status}, {"case", study.name}, {"levels", study.levels}, {"key", study_key(study)}};
  write_atomically(folder + "/cost.json", state.dump(2) + "\n");
}

/// The newest unfinished study of the same inputs, or a new folder.
std::string study_folder(const CostOptions& options, const CostStudy& study) {
  if (!options.out.empty()) return ensured_folder(options.out);
  const std::string base = "runs/" + file_name_of(study.name);
  std::error_code ignored;
  for (const auto& entry : files::directory_iterator(base, ignored)) {
    std::ifstream file(entry.path() / "cost.json");
    const auto state = file ? nlohmann::json::parse(file, nullptr, false) : nlohmann::json();
    if (state.is_object() && state.value("key", "") == study_key(study) && state.value("status", "") != "done")
      return entry.path();
  }
  return numbered_folder(base, "cost");
}

std::vector<std::string> run_command(const CostOptions& options, const PlannedRun& planned, const std::string& folder) {
  std::vector<std::string> argv{files::read_symlink("/proc/self/exe"),
                                "run",
                                options.case_path,
                                "--seed",
                                std::to_string(planned.seed),
                                "--out",
                                folder,
                                "--progress",
                                "json"};
  const auto add = [&](const std::string& name, const std::string& value) {
    argv.push_back(name), argv.push_back(value);
  };
  if (!planned.level.empty()) add("--level", planned.level);
  for (const auto& [key, value] : options.overrides.set) add("--set", fmt::format("{}={}", key, value));
  if (!options.overrides.structure_model.empty()) add("--structure", options.overrides.structure_model);
  if (options.threads.particle_count() > 0) add("--particle-threads", std::to_string(options.threads.particle_count()));
  if (options.threads.structure_count() > 0)
    add("--structure-threads", std::to_string(options.threads.structure_count()));
  if (options.max_time > 0.0) add("--max-time", fmt::format("{:g}", options.max_time));
  return argv;
}

/// Shows where one run is, a line every few seconds.
class RunTicker {
 public:
  RunTicker(std::string title, bool quiet) : title_(std::move(title)), quiet_(quiet) {}
  void take(const std::string& line) {
    const auto event = nlohmann::json::parse(line, nullptr, false);
    if (!event.is_object() || !event.contains("event")) {
      std::fprintf(stderr, "  %s\n", line.c_str());
      return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (quiet_ || event["event"] != "progress" || now - last_ < std::chrono::seconds(10)) return;
    last_ = now;
    const double windows = event.value("windows", 0.0);
    std::printf("%s  %s %.0f %%  ETA %s\n", title_.c_str(), event.value("phase", "").c_str(),
                windows > 0.0 ? 100.0 * event.value("window", 0.0) / windows : 0.0,
                clock_text(event.value("eta_s", -1.0)).c_str());
    std::fflush(stdout);
  }

 private:
  std::string title_;
  bool quiet_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void announce(const CostOptions& options, const CostStudy& study, const std::string& folder) {
  if (options.quiet) return;
  std::printf("%s: %zu runs (%zu levels x %d seeds), predicted %s, in %s\n", study.name.c_str(), study.runs.size(),
              study.levels.size(), options.seeds, wall_text(study.predicted_s).c_str(), folder.c_str());
  for (const std::string& level : study.left_out)
    std::printf("  level %s is left out: beyond the budget of %s (--budget, or name it in --levels)\n", level.c_str(),
                wall_text(options.budget).c_str());
}

std::string outcome(const CostRun& run) {
  if (run.exit_code != 0) return "failed";
  const bool at_rest = std::isfinite(run.permanent_m);
  return fmt::format("{} {:.2f} mm  impulse {:.1f} N s  {:.1f} s", at_rest ? "permanent" : "peak",
                     1e3 * (at_rest ? run.permanent_m : run.peak_m), run.impulse_Ns, run.seconds);
}

}  // namespace

std::string ensured_folder(const std::string& path) {
  std::error_code error;
  files::create_directories(path, error);
  if (error) throw Stop(ExitCode::bad_case, fmt::format("cannot create {}: {}", path, error.message()));
  return path;
}

std::optional<Cause> make_run(const CostOptions& options, const PlannedRun& planned, const std::string& title,
                              const std::string& folder, std::vector<CostRun>& runs) {
  auto run_folder = finished_run(folder, planned);
  std::optional<Cause> cause;
  const bool reused = run_folder.has_value();
  if (!reused) {
    run_folder = numbered_folder(
        folder, fmt::format("{}-seed-{}", planned.level.empty() ? "run" : file_name_of(planned.level), planned.seed));
    RunTicker ticker(title, options.quiet);
    cause = run_to_end("run", run_command(options, planned, *run_folder),
                       [&](const std::string& line) { ticker.take(line); });
  }
  runs.push_back(cost_run_of(*run_folder, planned));
  const CostRun& run = runs.back();
  if (!options.quiet)
    std::printf("%s  exit %d  %s%s\n", title.c_str(), run.exit_code, outcome(run).c_str(), reused ? "  (reused)" : "");
  std::fflush(stdout);
  if (cause && (cause->code == ExitCode::interrupted || run.exit_code == static_cast<int>(ExitCode::bad_case)))
    return cause;
  return std::nullopt;
}

namespace {

void draw(const std::string& folder) {
  const std::string trouble = run_report_script("cost_figure.py", {folder});
  if (!trouble.empty()) std::printf("no figure was drawn: %s; cost.csv holds the numbers\n", trouble.c_str());
}

}  // namespace

int cost_verb(const CostOptions& options) {
  if (options.effects) return effect_cost_verb(options);
  const CostStudy study = plan_study(options);
  const std::string folder = study_folder(options, study);
  announce(options, study, folder);
  write_state(folder, study, "running");
  std::vector<CostRun> runs;
  for (std::size_t i = 0; i < study.runs.size(); ++i) {
    const PlannedRun& planned = study.runs[i];
    const std::string title = fmt::format("[{}/{}] {} seed {}", i + 1, study.runs.size(), planned.level, planned.seed);
    const auto cause = make_run(options, planned, title, folder, runs);
    write_atomically(folder + "/cost.csv", cost_csv(runs));
    write_atomically(folder + "/stages.csv", stage_csv(runs));
    if (!cause) continue;
    write_state(folder, study, "interrupted");
    std::fprintf(stderr, "standoff: %s; the same command continues the study\n", cause->what.c_str());
    return static_cast<int>(cause->code);
  }
  std::printf("\n%s\n%s\n", cost_table(level_costs(runs, study.levels)).c_str(),
              stage_table(runs, study.levels).c_str());
  std::fflush(stdout);
  draw(folder);
  write_state(folder, study, "done");
  std::printf("%s/cost.csv\n", folder.c_str());
  const bool all_good = std::all_of(runs.begin(), runs.end(), [](const CostRun& r) { return r.exit_code == 0; });
  return static_cast<int>(all_good ? ExitCode::done : ExitCode::check_failed);
}

}  // namespace standoff::launch
