#pragma once
// run.json: what the launcher knows, merged with what the participants report. Pure functions of their arguments.
//
// Numbers that belong to neither process alone, over the whole run and as simulated:
//   interface_work_error = max |W_given - W_received| / W_external            (rows of histories.csv and the end)
//   momentum_error       = |r_p + r_s + J_received - J_given| / (S_p + S_s)
// with r_p = P_p + J_given + boundaries - P_0 and r_s = P_s - J_received - supports the residuals of the two books:
// their sum corrected by what got lost between them is particles + structure + supports + mirrors + boundaries -
// initial; S is the sum of |impulses| of each book. Reports carry r as conservation.momentum_residual_Ns [3] and S as
// conservation.impulse_scale_Ns.
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "coupling/case/case_spec.hpp"
#include "coupling/launcher/broker_events.hpp"
#include "coupling/launcher/build_facts.hpp"

namespace standoff::launch {

using OrderedJson = nlohmann::ordered_json;

/// What the launcher itself knows at one moment of the run.
struct RunFacts {
  std::string status = "running";  // running, done, failed, interrupted
  std::optional<int> exit_code;
  std::string reason;
  std::string case_hash;
  std::string structure_model;  // "" = the case's
  double wall_s = 0.0;
  int particle_threads = 1, structure_threads = 1;
  std::optional<ClockEvent> clock;
  std::optional<InterfaceEvent> interface_ledger;
  double largest_work_error = 0.0, largest_external_work = 0.0;  // J, full domain, over histories.csv
  std::map<std::string, double> effect_bytes;                    // predicted; a report's own figure wins
  std::map<std::string, long> peak_bytes;                        // resident memory by process
  std::map<std::string, double> cpu_s;  // processor time by process, whatever else the machine does
  BuildFacts build;
  std::string cpu;
};

/// `reports` by participant name; a fragment that reports the same key as another is merged after it, in order of name.
OrderedJson run_record(const CaseSpec& spec, const RunFacts& facts,
                       const std::map<std::string, nlohmann::json>& reports);

/// The number behind a dotted key ("results.impulse_Ns"), nothing if it is absent or not a number.
std::optional<double> number_at(const OrderedJson& record, const std::string& dotted);

}  // namespace standoff::launch
