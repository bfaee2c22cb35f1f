#pragma once
// One run from the checked case to the result table: folder, processes, events, record.
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "coupling/case/case_reader.hpp"
#include "coupling/launcher/history_table.hpp"
#include "coupling/launcher/prediction.hpp"
#include "coupling/launcher/private_folder.hpp"
#include "coupling/launcher/progress_view.hpp"
#include "coupling/launcher/run_log.hpp"
#include "coupling/launcher/run_record.hpp"
#include "coupling/launcher/supervisor.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

/// Where a run is taken up again.
struct Continuation {
  std::string checkpoint;  // its folder
  long windows = 0;        // done in it
  double time = 0.0;       // s, of their end
  double window = 0.0;     // s
  double wall = 0.0;       // s of wall clock in earlier sessions
};

class RunSession {
 public:
  /// `folder` exists and holds no run, or one to be continued; `read` has no errors.
  RunSession(const RunOptions& options, const CaseRead& read, std::string folder,
             std::optional<Continuation> continuation = std::nullopt);
  /// Exit code of the run; everything a user needs to know is printed.
  int run();

  // One function for each event of the broker.
  void operator()(const JoinedEvent& event);
  void operator()(const ClockEvent& event);
  void operator()(const WaitingEvent& event);
  void operator()(const ProgressEvent& event);
  void operator()(const SampleEvent& event);
  void operator()(const ReportEvent& event);
  void operator()(const InterfaceEvent& event);
  void operator()(const SavingEvent& event);
  void operator()(const CheckpointEvent& event);
  void operator()(const FailedEvent& event);
  void operator()(const DoneEvent& event);

 private:
  void start_processes();
  void take_line(const ChildProcess& child, bool error_output, const std::string& line);
  void write_record();
  void trace_into(ChildCommand& command) const;
  void join_traces() const;
  int close(std::optional<Cause> cause);
  void explain(const Cause& cause) const;
  void print_result(const OrderedJson& record);
  double wall() const;  // s, earlier sessions included

  const RunOptions& options_;
  const CaseRead& read_;
  std::string folder_;
  std::optional<Continuation> continuation_;
  CostPrediction plan_;
  RunFacts facts_;
  std::map<std::string, nlohmann::json> reports_;
  RunLog log_;
  HistoryTable table_;
  GrowingFile histories_;
  ProgressView view_;
  PrivateFolder sockets_;
  Supervisor supervisor_;
  double last_progress_logged_ = -1e9;
  long saved_windows_ = 0;  // in the last checkpoint
};

}  // namespace standoff::launch
