#pragma once
// What a user sees while a case runs: one line that is rewritten on a terminal, a plain line every few seconds
// elsewhere, or one JSON object a line for programs.
#include <chrono>
#include <deque>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "coupling/launcher/broker_events.hpp"

namespace standoff::launch {

/// Latest knowledge of a run; NaN = not known.
struct RunProgress {
  double time_s = 0.0, until_s = 0.0;
  long window = 0, windows = 0;
  double step_s, impulse_Ns, energy_error;
  std::string limited_by;
  bool relaxing = false;
  double relax_time_s, kinetic_ratio, centre_deflection_m;
  double eta_s;
  RunProgress();

  void take(const ClockEvent& event);
  /// Values of the load side (time_s, window, ..., "limited_by:NAME" = 1) or of a relaxation (relax_time_s, ...).
  void take(const ProgressEvent& event);
};

/// "t 0.412/2.000 ms  21 %  window 1,234/6,000  dt 38 ns (limited by gas_collide)  impulse 201.3 N s  ..."
std::string progress_line(const RunProgress& progress);
nlohmann::json progress_json(const RunProgress& progress);
/// "t 0.412 of 2.000 ms, window 1,234 of 6,000": when something happened.
std::string when_text(const RunProgress& progress);

/// Remaining seconds from the windows of the last few seconds: the pace of now, not the mean since the start.
class PaceMeter {
 public:
  void add(double wall_s, long window);
  double remaining(long windows) const;  // NaN until there is a pace

 private:
  std::deque<std::pair<double, long>> recent_;
};

enum class ViewMode { terminal, plain, json, quiet };

class ProgressView {
 public:
  explicit ProgressView(ViewMode mode) : mode_(mode) {}
  RunProgress& progress() { return progress_; }
  const RunProgress& progress() const { return progress_; }
  /// Shows what is new, not more often than is readable.
  void show(double wall_s);
  /// A line that stays, above the progress line.
  void note(const std::string& text);
  /// Ends a rewritten line.
  void end_line();
  ViewMode mode() const { return mode_; }

 private:
  ViewMode mode_;
  RunProgress progress_;
  PaceMeter pace_;
  double last_shown_ = -1e9;
  std::string last_text_;
  bool line_open_ = false;
};

/// Terminal if standard output is one, else plain.
ViewMode view_mode(bool quiet, bool json);

}  // namespace standoff::launch
