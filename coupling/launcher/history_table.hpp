#pragma once
// histories.csv: every participant sends its half of a row when it reaches an output time; a row is written once all
// halves are there. Rows are keyed by the integer index time / interval, so that two sides whose windows end a rounding
// error apart still meet in one row.
//
// Columns are those of the contract, in its order, then what else was sent, by name. The first complete row fixes them:
// a medium that is not in the scene has no column.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "coupling/launcher/broker_events.hpp"

namespace standoff::launch {

class HistoryTable {
 public:
  /// `interval` [s] between rows; `participants` that each send a half.
  HistoryTable(double interval, int participants);

  /// Takes one half and returns the text that histories.csv grows by, often nothing.
  std::string add(const SampleEvent& half);
  /// Goes on with a table that was written before: returns the rows of `text` up to `time` [s], knows its columns
  /// again.
  std::string take_up(const std::string& text, double time);
  /// At the end of a run that broke off: the rows that miss a half, with empty fields.
  std::string finish();

  /// Largest |work given by the particles - work received by the structure| over the rows so far, J.
  double largest_work_error() const { return largest_work_error_; }
  /// Largest external work over the rows so far, J.
  double largest_external_work() const { return largest_external_work_; }
  long rows() const { return rows_; }

 private:
  struct Row {
    std::map<std::string, double> times;  // by participant
    Values values;
  };
  std::string write(const Row& row);
  void note_work(const Values& values);
  std::string take_until(long last_index);

  double interval_;
  std::size_t participants_;
  std::map<long, Row> waiting_;
  std::vector<std::string> columns_;
  long rows_ = 0, last_written_ = -1;
  double largest_work_error_ = 0.0, largest_external_work_ = 0.0;
};

}  // namespace standoff::launch
