#pragma once
// The runs of one `standoff cost`: which there are, which of them are already finished, running the rest one after the
// other.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coupling/launcher/cost_statistics.hpp"
#include "coupling/launcher/first_cause.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

/// One run to be made: its inputs are known by their hash, so that a finished run is reused only if nothing has
/// changed.
struct PlannedRun {
  std::string level;
  std::uint64_t seed = 1;
  std::string case_hash;
  double predicted_s = 0.0;
};

struct CostStudy {
  std::string name;                 // of the case
  std::vector<std::string> levels;  // chosen, in the order of the case
  std::vector<PlannedRun> runs;     // level by level
  double predicted_s = 0.0;
  std::vector<std::string> left_out;  // levels beyond the budget
};

/// Reads the case at every level and seed; throws Stop(bad_case) with all errors printed if one of them is wrong.
CostStudy plan_study(const CostOptions& options);

/// Levels that fit: in order, as long as the sum of `predicted` stays within `budget`; the first always.
std::size_t levels_within(const std::vector<double>& predicted, double budget);

/// Folder of a finished run of `planned` below `study_folder`, if there is one.
std::optional<std::string> finished_run(const std::string& study_folder, const PlannedRun& planned);

/// Figures of a run folder; exit_code from its run.json.
CostRun cost_run_of(const std::string& run_folder, const PlannedRun& planned);

/// Makes or reuses one run below `folder` and adds its figures to `runs`. Returns the cause if the study itself must
/// end (interrupted, wrong case).
std::optional<Cause> make_run(const CostOptions& options, const PlannedRun& planned, const std::string& title,
                              const std::string& folder, std::vector<CostRun>& runs);

/// `path`, made if it is not there; throws Stop(bad_case) if it cannot be.
std::string ensured_folder(const std::string& path);

/// Starts a program, waits, passes its output on; obeys signals. Nothing if it ended with status 0.
std::optional<Cause> run_to_end(const std::string& name, const std::vector<std::string>& argv,
                                const std::function<void(const std::string& line)>& take);

}  // namespace standoff::launch
