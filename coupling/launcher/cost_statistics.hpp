#pragma once
// What accuracy costs, from runs of several levels with several seeds. One run is not a measurement: every number
// carries the spread over seeds, and the error of a level against the finest carries its standard error
//   SE = sqrt(s_a^2 / n_a + s_b^2 / n_b)      (difference of two independent means, Welch 1947)
#include <cstdint>
#include <string>
#include <vector>

namespace standoff::launch {

/// Wall-clock seconds of one stage of a process in a run; "exchange" and "wait" beside the stages.
struct StageTime {
  std::string process, stage;
  double seconds = 0.0;
};

/// One finished or failed run. A value that a run did not produce is NaN.
struct CostRun {
  std::string level;
  std::uint64_t seed = 0;
  int exit_code = 0;
  long charge_particles = 0, sand_particles = 0, elements = 0;
  double permanent_m, maximum_m, peak_m;  // deflections
  double impulse_Ns;
  double seconds;      // by the clock on the wall: longer where others use the machine
  double processor_s;  // of all processes together
  double energy_error_particles, energy_error_structure;
  std::vector<StageTime> stages;
  CostRun();
};

/// Mean and spread of a quantity over the seeds of a level.
struct Spread {
  int count = 0;
  double mean, deviation;  // deviation with n - 1; NaN for fewer than two
  Spread();
  double standard_error() const;
};
Spread spread_of(const std::vector<double>& values);  // NaN values are left out

/// A quantity of one level beside the finest one.
struct LevelError {
  Spread own;
  double difference, standard_error;  // mean - mean of the finest; NaN if unknown, 0 for the finest itself
  LevelError();
};

struct LevelCost {
  std::string level;
  int runs = 0, failed = 0;
  LevelError permanent, maximum, peak, impulse;
  Spread seconds, processor_s;
};

/// One entry for each of `levels` that has runs, in that order; the last with a successful run is the finest.
std::vector<LevelCost> level_costs(const std::vector<CostRun>& runs, const std::vector<std::string>& levels);

/// Cheapest level whose permanent deflection (peak, where nothing was brought to rest) lies within `wanted` (a
/// fraction) of the finest, two standard errors included;
/// "" if none does, or if no level but the finest was run.
std::string level_for_error(const std::vector<LevelCost>& costs, double wanted);

/// The table a user reads, and below it the level to choose for a wanted error.
std::string cost_table(const std::vector<LevelCost>& costs);
/// One line per run, for cost.csv.
std::string cost_csv(const std::vector<CostRun>& runs);

}  // namespace standoff::launch
