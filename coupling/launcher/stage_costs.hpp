#pragma once
// Where the seconds of a run go: stages of each process, its exchange and its waiting, from run.json. The two processes
// work side by side, so each has a whole of its own: the seconds of its stages, of exchange and of waiting.
#include <string>
#include <vector>

#include "coupling/launcher/cost_statistics.hpp"
#include "coupling/launcher/run_record.hpp"

namespace standoff::launch {

/// Stages, then "exchange" and "wait", of the particles and of the structure, as far as `record` has them.
std::vector<StageTime> stage_times_of(const OrderedJson& record);

/// A row per stage, the dearest first, a column per level that has runs: mean seconds and share of its process.
std::string stage_table(const std::vector<CostRun>& runs, const std::vector<std::string>& levels);

/// One line per run and stage, for stages.csv.
std::string stage_csv(const std::vector<CostRun>& runs);

}  // namespace standoff::launch
