#include "coupling/launcher/history_table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace standoff::launch {
namespace {

const std::vector<std::string>& contract_columns() {
  static const std::vector<std::string> names{"time_s",
                                              "impulse_Ns",
                                              "impulse_gas_Ns",
                                              "impulse_sand_Ns",
                                              "impulse_air_Ns",
                                              "centre_deflection_m",
                                              "gas_internal_J",
                                              "gas_kinetic_J",
                                              "sand_kinetic_J",
                                              "sand_elastic_J",
                                              "friction_loss_J",
                                              "damping_loss_J",
                                              "plate_kinetic_J",
                                              "plate_elastic_J",
                                              "plate_plastic_J",
                                              "plate_damping_J",
                                              "external_work_J",
                                              "boundary_work_J",
                                              "escaped_J",
                                              "interface_work_error_J",
                                              "sand_front_radius_m"};
  return names;
}

std::vector<std::string> columns_for(const Values& values) {
  std::vector<std::string> columns;
  for (const std::string& name : contract_columns())
    if (values.contains(name)) columns.push_back(name);
  for (const auto& [name, value] : values)
    if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  return columns;
}

std::string joined(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) line += (i > 0 ? "," : "") + fields[i];
  return line + "\n";
}

}  // namespace

HistoryTable::HistoryTable(double interval, int participants)
    : interval_(interval), participants_(static_cast<std::size_t>(participants)) {}

std::string HistoryTable::add(const SampleEvent& half) {
  const long index = std::lround(half.time_s / interval_);
  if (index <= last_written_) return "";  // a participant that repeats itself
  Row& row = waiting_[index];
  row.times[half.name] = half.time_s;
  for (const auto& [name, value] : half.values) row.values[name] = value;
  return row.times.size() >= participants_ ? take_until(index) : "";
}

std::string HistoryTable::take_until(long last_index) {
  std::string text;
  while (!waiting_.empty() && waiting_.begin()->first <= last_index) {
    text += write(waiting_.begin()->second);
    last_written_ = waiting_.begin()->first;
    waiting_.erase(waiting_.begin());
  }
  return text;
}

std::string HistoryTable::finish() {
  return waiting_.empty() ? "" : take_until(waiting_.rbegin()->first);
}

namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream text(line + ",");
  for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
  return fields;
}

}  // namespace

std::string HistoryTable::take_up(const std::string& text, double time) {
  std::istringstream lines(text);
  std::string kept, line;
  while (std::getline(lines, line) && !lines.eof()) {  // a line without its end was never written whole
    const std::vector<std::string> fields = fields_of(line);
    if (columns_.empty()) {
      columns_ = fields;
    } else {
      Values values;
      for (std::size_t i = 0; i < std::min(fields.size(), columns_.size()); ++i)
        if (!fields[i].empty()) values[columns_[i]] = std::stod(fields[i]);
      if (!(values["time_s"] <= time)) break;
      note_work(values);
      last_written_ = std::lround(values["time_s"] / interval_);
      ++rows_;
    }
    kept += line + "\n";
  }
  return kept;
}

void HistoryTable::note_work(const Values& values) {
  if (const auto error = values.find("interface_work_error_J"); error != values.end())
    largest_work_error_ = std::max(largest_work_error_, std::abs(error->second));
  if (const auto work = values.find("external_work_J"); work != values.end())
    largest_external_work_ = std::max(largest_external_work_, work->second);
}

std::string HistoryTable::write(const Row& row) {
  Values values = row.values;
  values["time_s"] = row.times.begin()->second;
  if (values.contains("work_to_structure_J") && values.contains("external_work_J"))
    values["interface_work_error_J"] = values["work_to_structure_J"] - values["external_work_J"];
  note_work(values);

  std::string text;
  if (columns_.empty()) {
    columns_ = columns_for(values);
    text = joined(columns_);
  }
  std::vector<std::string> fields;
  for (const std::string& name : columns_) {
    const auto at = values.find(name);
    fields.push_back(at == values.end() || !std::isfinite(at->second) ? "" : fmt::format("{:.10g}", at->second));
  }
  ++rows_;
  return text + joined(fields);
}

}  // namespace standoff::launch
