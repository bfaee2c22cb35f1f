#pragma once
// Wall-clock seconds per stage of the time loop. The stage name is the file name and the row of the report; a stage
// that is never registered has no row.
#include <chrono>
#include <string>
#include <vector>

namespace standoff {

class StageTimers {
 public:
  struct Row {
    std::string name;
    double seconds = 0.0;
    long calls = 0;
  };

  /// Registers a stage and returns its index; call once, before the loop.
  int add(std::string name) {
    rows_.push_back({std::move(name)});
    return static_cast<int>(rows_.size()) - 1;
  }
  const std::vector<Row>& rows() const { return rows_; }

  /// Runs `body` and books its time on `stage`.
  template <class Body>
  void time(int stage, Body&& body) {
    const auto begin = std::chrono::steady_clock::now();
    body();
    book(stage, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  void book(int stage, double seconds) {
    rows_[static_cast<std::size_t>(stage)].seconds += seconds;
    ++rows_[static_cast<std::size_t>(stage)].calls;
  }
  void reset() {
    for (Row& row : rows_) row.seconds = 0.0, row.calls = 0;
  }
  /// Seconds and calls; the stages are those that were added.
  template <class Archive>
  void archive(Archive& a) {
    for (Row& row : rows_) a(row.seconds, row.calls);
  }

 private:
  std::vector<Row> rows_;
};

/// Seconds since construction.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace standoff
