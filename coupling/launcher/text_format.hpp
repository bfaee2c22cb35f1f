#pragma once
// Numbers as people read them: a unit that fits, separators in long counts.
#include <string>
#include <vector>

namespace standoff::launch {

/// 1234567 -> "1,234,567".
std::string with_separators(long value);
/// 41 s -> "00:00:41"; "--:--:--" when unknown (NaN, infinite or negative).
std::string clock_text(double seconds);
/// Seconds with a unit that fits: "38 ns", "1.25 us", "0.412 ms", "12.3 s".
std::string duration_text(double seconds);
/// Bytes with a unit that fits: "351 kB", "1.2 GB".
std::string bytes_text(double bytes);
/// "412.0 s", "3.2 min", "1.5 h": for wall-clock predictions.
std::string wall_text(double seconds);
/// The value of a key of the contract in a unit people use, taken from the suffix: ..._m in mm, ..._Ns in N s.
std::string value_text(const std::string& key, double value);
/// "results.permanent_centre_deflection_m" -> "permanent centre deflection".
std::string label_of(const std::string& key);

/// Lines of a table with columns padded to equal width; `right` says which columns align right.
std::string table_text(const std::vector<std::vector<std::string>>& rows, const std::vector<bool>& right,
                       const std::string& indent = "  ");

}  // namespace standoff::launch
