#pragma once
// Comma-separated tables with the unit in the column name (impulse_Ns, deflection_m): read by people, spreadsheets,
// numpy.
#include <string>
#include <vector>

namespace standoff {

/// Text of a table; every row has as many values as there are columns. Ten significant digits; NaN is an empty field.
std::string csv_text(const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows);

}  // namespace standoff
