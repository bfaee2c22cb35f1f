#include "coupling/output/csv_table.hpp"

#include <cmath>

#include <fmt/format.h>

namespace standoff {

std::string csv_text(const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!std::isnan(row[i])) text += fmt::format("{:.10g}", row[i]);
      text += i + 1 < row.size() ? ',' : '\n';
    }
  return text;
}

}  // namespace standoff
