#pragma once
// What each effect of a scene costs and does, measured: the case as it is, and once with every effect turned round that
// can be, all with the same seeds. Differences are taken seed by seed (paired), mean and standard error
//   d_k = (turned - as it is) of seed k,   SE = s_d / sqrt(n)
// so that what the seeds have in common drops out. A scene of particles is chaotic: runs of the same seed part after
// some collisions, so the standard error says what of a difference is scatter.
#include <string>
#include <utility>
#include <vector>

#include "coupling/launcher/cost_statistics.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

/// One way to run the case: as it is (no name), or with one effect turned round.
struct EffectVariant {
  std::string effect;
  bool on = false;                          // what it is turned to
  std::pair<std::string, std::string> set;  // the statement that does it
};

/// The case as it is, then every effect whose override the case accepts, in the order of the list.
std::vector<EffectVariant> effect_variants(const CostOptions& options, const std::string& level);

struct EffectRuns {
  EffectVariant variant;
  std::vector<CostRun> runs;  // by seed, the same in all
};

/// Paired differences from the case as it is. Processor seconds of all processes together: the clock on the wall also
/// counts what others do on the machine.
struct EffectDifference {
  Spread processor_s, permanent, peak, impulse;
};
EffectDifference paired_difference(const std::vector<CostRun>& turned, const std::vector<CostRun>& as_it_is);

/// The first of `all` is the case as it is.
std::string effect_table(const std::vector<EffectRuns>& all);
/// A line a run, for cost-effects.csv.
std::string effect_csv(const std::vector<EffectRuns>& all);

/// `standoff cost CASE --effects`.
int effect_cost_verb(const CostOptions& options);

}  // namespace standoff::launch
