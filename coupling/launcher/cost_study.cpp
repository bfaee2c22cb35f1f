#include "coupling/launcher/cost_study.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "coupling/case/near_word.hpp"
#include "coupling/case/structural_models.hpp"
#include "coupling/launcher/build_facts.hpp"
#include "coupling/launcher/prediction.hpp"
#include "coupling/launcher/run_folder.hpp"
#include "coupling/launcher/run_record.hpp"
#include "coupling/launcher/stage_costs.hpp"
#include "coupling/launcher/supervisor.hpp"

namespace standoff::launch {
namespace {

CaseRead read_or_stop(const CostOptions& options, const std::string& level, const std::string& seed) {
  CaseOverrides overrides = options.overrides;
  overrides.level = level;
  overrides.seed = seed;
  CaseRead read = read_case(options.case_path, overrides);
  if (!print_diagnostics(read)) throw Stop(ExitCode::bad_case, "the case is wrong, see above");
  return read;
}

std::vector<std::string> chosen_levels(const CostOptions& options, const std::vector<std::string>& known) {
  for (const std::string& level : options.levels)
    if (std::find(known.begin(), known.end(), level) == known.end())
      throw Stop(ExitCode::bad_case,
                 fmt::format("unknown level \"{}\"\n  {}", level, did_you_mean(level, known, "levels")));
  if (known.empty()) return {""};
  if (options.levels.empty()) return known;
  std::vector<std::string> chosen;  // in the order of the case: the last is the finest
  for (const std::string& level : known)
    if (std::find(options.levels.begin(), options.levels.end(), level) != options.levels.end()) chosen.push_back(level);
  return chosen;
}

std::optional<OrderedJson> record_of(const std::string& folder) {
  std::ifstream file(folder + "/run.json");
  if (!file) return std::nullopt;
  OrderedJson record = OrderedJson::parse(file, nullptr, false);
  if (!record.is_object()) return std::nullopt;
  return record;
}

std::string run_stem(const PlannedRun& planned) {
  return fmt::format("{}-seed-{}", planned.level.empty() ? "run" : file_name_of(planned.level), planned.seed);
}

}  // namespace

std::size_t levels_within(const std::vector<double>& predicted, double budget) {
  double sum = 0.0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    sum += predicted[i];
    if (sum > budget && i > 0) return i;
  }
  return predicted.size();
}

CostStudy plan_study(const CostOptions& options) {
  const CaseRead first = read_or_stop(options, "", "");
  if (first.spec.plate.model == material_point_model)
    throw Stop(ExitCode::bad_case,
               "a material point has no mesh and no particles: there is no accuracy to be bought\n"
               "  `standoff run` draws its flow curves; plate.model chooses a plate");
  CostStudy study;
  study.name = first.spec.name;
  const std::vector<std::string> levels = chosen_levels(options, first.spec.levels);
  std::vector<double> predicted;
  std::vector<CaseRead> cases;
  for (const std::string& level : levels) {
    cases.push_back(read_or_stop(options, level, ""));
    predicted.push_back(options.seeds * predict_cost(cases.back().spec, usable_cores(),
                                                     options.threads.particle_count(),
                                                     options.threads.structure_count())
                                            .wall_s);
  }
  const std::size_t count = options.levels.empty() ? levels_within(predicted, options.budget) : levels.size();
  study.levels.assign(levels.begin(), levels.begin() + static_cast<long>(count));
  study.left_out.assign(levels.begin() + static_cast<long>(count), levels.end());
  for (std::size_t i = 0; i < count; ++i) {
    study.predicted_s += predicted[i];
    const std::uint64_t first_seed = cases[i].spec.run.seed;
    for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(options.seeds); ++seed)
      study.runs.push_back(
          {levels[i], seed, read_or_stop(options, levels[i], std::to_string(seed)).hash, predicted[i] / options.seeds});
  }
  return study;
}

std::optional<std::string> finished_run(const std::string& study_folder, const PlannedRun& planned) {
  std::error_code ignored;
  std::set<std::string> candidates;
  for (const auto& entry : std::filesystem::directory_iterator(study_folder, ignored))
    if (entry.path().filename().string().starts_with(run_stem(planned) + "-")) candidates.insert(entry.path());
  for (const std::string& folder : candidates) {
    const auto record = record_of(folder);
    if (record && record->value("status", "") == "done" &&
        record->value(OrderedJson::json_pointer("/provenance/case_hash"), std::string()) == planned.case_hash)
      return folder;
  }
  return std::nullopt;
}

CostRun cost_run_of(const std::string& run_folder, const PlannedRun& planned) {
  CostRun run;
  run.level = planned.level;
  run.seed = planned.seed;
  run.exit_code = static_cast<int>(ExitCode::participant_lost);
  const auto record = record_of(run_folder);
  if (!record) return run;
  const auto take = [&](double& target, const char* key) { target = number_at(*record, key).value_or(target); };
  const auto count = [&](const char* key) { return static_cast<long>(number_at(*record, key).value_or(0.0)); };
  run.exit_code = static_cast<int>(number_at(*record, "exit_code").value_or(run.exit_code));
  run.charge_particles = count("counts.charge_particles");
  run.sand_particles = count("counts.sand_particles");
  run.elements = count("counts.elements");
  take(run.permanent_m, "results.permanent_centre_deflection_m");
  take(run.maximum_m, "results.permanent_max_deflection_m");
  take(run.peak_m, "results.peak_centre_deflection_m");
  take(run.impulse_Ns, "results.impulse_Ns");
  take(run.seconds, "timing.wall_s");
  take(run.energy_error_particles, "conservation.energy_error_particles");
  take(run.energy_error_structure, "conservation.energy_error_structure");
  if (const auto processes = record->find("timing"); processes != record->end() && processes->contains("cpu_s")) {
    run.processor_s = 0.0;
    for (const auto& [process, seconds] : (*processes)["cpu_s"].items()) run.processor_s += seconds.get<double>();
  }
  run.stages = stage_times_of(*record);
  return run;
}

std::optional<Cause> run_to_end(const std::string& name, const std::vector<std::string>& argv,
                                const std::function<void(const std::string& line)>& take) {
  SupervisorTimes times;
  times.terminate = 12.0;        // it has processes of its own to stop
  times.end_after_done = 1e300;  // it ends when it ends
  times.settle = 0.0;
  Supervisor supervisor(times, {[&](const ChildProcess&, bool, const std::string& line) { take(line); }, [] {}});
  supervisor.broker_done();
  supervisor.start({name, argv, {}, SIGTERM});
  return supervisor.watch();
}

}  // namespace standoff::launch
