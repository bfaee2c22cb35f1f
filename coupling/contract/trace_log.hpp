#pragma once
// What a participant did when, for Chrome's and Perfetto's trace viewers: a slice for each window it computed, in it
// one for each stage (its seconds in that window, laid end to end), and slices for waiting. Bounded: when there are too
// many windows every other one is dropped and from then on only every second, fourth, ... is kept.
//
// Times are those of the monotonic clock, which all processes of one machine share.
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/base/stage_timer.hpp"

namespace standoff {

class TraceLog {
 public:
  explicit TraceLog(std::size_t most_windows = 4096) : most_(most_windows) {}
  static double now();  // us

  /// Stage seconds spent so far belong to no window.
  void begin(const StageTimers* stages);
  /// A window that was computed from `begin` to `end` [us] after `wait` us of waiting. Stages may be null.
  void window(std::int64_t number, double wait, double begin, double end, const StageTimers* stages);
  /// Trace events, one JSON object a line, for the track of process `pid` called `name`.
  std::string lines(const std::string& name, long pid) const;

 private:
  struct Window {
    std::int64_t number = 0;
    double wait = 0.0, begin = 0.0, end = 0.0;  // us
    std::vector<double> stages;                 // us
  };
  std::size_t most_;
  std::int64_t stride_ = 1;
  std::vector<Window> windows_;
  std::vector<std::string> names_;
  std::vector<double> before_;  // s of each stage at the end of the last window
};

}  // namespace standoff
