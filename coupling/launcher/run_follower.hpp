#pragma once
// Reads a run folder from outside, while the run is written or afterwards: run.json for what is certain, log.jsonl for
// where the run is. Used by `status` (one look) and `watch` (again and again).
#include <fstream>
#include <string>
#include <vector>

#include "coupling/launcher/progress_view.hpp"
#include "coupling/launcher/run_record.hpp"

namespace standoff::launch {

/// run.json of `folder`; Stop(bad_case) that says what is wrong if there is none or it cannot be read.
OrderedJson read_record(const std::string& folder);

class RunFollower {
 public:
  explicit RunFollower(std::string folder);

  /// Reads what is new. Lines that are not complete yet wait for the next call.
  void catch_up();
  const OrderedJson& record() const { return record_; }
  const RunProgress& progress() const { return progress_; }
  double wall_s() const { return wall_s_; }
  /// What the log says beside progress and what has not been taken yet: who joined, who is waited for, what failed.
  std::vector<std::string> take_notes();
  /// "running", "done", "failed", "interrupted", or "abandoned": marked running, but its processes on this machine are
  /// gone and nothing was written for a while.
  std::string status() const;

 private:
  void take(const std::string& line);
  bool silent() const;

  std::string folder_;
  std::ifstream log_;
  std::string partial_;
  OrderedJson record_;
  RunProgress progress_;
  std::vector<long> pids_;
  std::vector<std::string> notes_;
  double wall_s_ = 0.0;
};

/// One snapshot, for programs and for people.
OrderedJson snapshot_json(const RunFollower& run);
std::string snapshot_text(const std::string& folder, const RunFollower& run);

}  // namespace standoff::launch
