#pragma once
// What differs between two tapes, field by field, and what one tape holds in numbers.
#include "coupling/tape/tape_reader.hpp"

namespace standoff {

/// Of one field over all windows that both tapes hold.
struct FieldDifference {
  std::string name;                // "force", "position", "velocity"
  double largest = 0.0;            // |difference| of a node's vector: N, m, m/s
  double rms = 0.0;                // over nodes and windows
  double scale = 0.0;              // largest |value| on the first tape; for positions the largest way from rest
  std::int64_t first_window = -1;  // where they first differ at all, -1: the same bits
  double relative() const { return scale > 0.0 ? largest / scale : largest; }
};

struct TapeDifference {
  std::vector<FieldDifference> fields;
  std::string structure;     // why the tapes cannot be compared at all (surface, clock); empty if they can
  std::int64_t windows = 0;  // compared
  std::int64_t only_first = 0, only_second = 0;  // frames that only one tape holds
  bool same() const;
};

TapeDifference compare_tapes(TapeReader& first, TapeReader& second);

/// One line for each window of the load side and what the structure answered, as CSV.
std::string tape_csv(TapeReader& tape);

}  // namespace standoff
