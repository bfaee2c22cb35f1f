#include "coupling/launcher/result_table.hpp"

#include <cmath>

#include <fmt/format.h>

#include "coupling/launcher/text_format.hpp"

namespace standoff::launch {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string percent(double fraction) {
  return fmt::format("{:.2g} %", 100.0 * fraction);
}

Rows result_rows(const OrderedJson& record, const std::vector<ReferenceValue>& references) {
  Rows rows{{"quantity", "ours", "reference", "difference", "source"}};
  if (!record.contains("results")) return rows;
  for (const auto& [key, value] : record["results"].items()) {
    if (!value.is_number()) continue;
    const double ours = value.get<double>();
    bool first = true;
    for (const ReferenceValue& reference : references) {
      if (reference.quantity != key) continue;
      rows.push_back({first ? label_of(key) : "", first ? value_text(key, ours) : "", value_text(key, reference.value),
                      reference.value != 0.0 ? fmt::format("{:+.1f} %", 100.0 * (ours / reference.value - 1.0)) : "",
                      reference.source});
      first = false;
    }
    if (first) rows.push_back({label_of(key), value_text(key, ours), "", "", ""});
  }
  return rows;
}

std::string conservation_text(const OrderedJson& record) {
  Rows rows;
  const std::pair<const char*, const char*> books[] = {
      {"energy_error_particles", "energy of the particles, of initial energy and inflow"},
      {"energy_error_structure", "energy of the structure, of peak external work"},
      {"interface_work_error", "work across the interface, of external work (the window's price)"}};
  for (const auto& [key, label] : books)
    if (const auto value = number_at(record, std::string("conservation.") + key))
      rows.push_back({label, percent(*value)});
  if (const auto value = number_at(record, "conservation.momentum_error"))
    rows.push_back({"momentum of everything, of the sum of impulses", fmt::format("{:.1e}", *value)});
  return rows.empty() ? "" : "conservation, largest errors\n" + table_text(rows, {false, true});
}

std::string rest_text(const OrderedJson& record) {
  if (!record.contains("relaxation")) return "";
  const bool at_rest = record["relaxation"].value("at_rest", false);
  std::string text = fmt::format("at rest: {}", at_rest ? "yes" : "NO");
  if (const auto v = number_at(record, "relaxation.kinetic_ratio"))
    text += fmt::format("; kinetic energy {:.1e} of its peak", *v);
  if (const auto v = number_at(record, "relaxation.residual_N")) text += fmt::format(", unbalanced force {:.2g} N", *v);
  if (const auto v = number_at(record, "relaxation.drift_m_per_period"))
    text += fmt::format(", drift {:.2g} um over a period", *v * 1e6);
  if (const auto v = number_at(record, "relaxation.polish_difference_m"))
    text += fmt::format(", polish moved the centre {:.2g} um", *v * 1e6);
  return text + "\n";
}

/// How the air was resolved. Molecules of still air meet every 0.07 um; here the mean free path is what the number of
/// particles buys, and a shock is a few of them wide.
std::string air_text(const OrderedJson& record) {
  if (!record.contains("air")) return "";
  const auto at = [&](const char* key) { return number_at(record, std::string("air.") + key).value_or(0.0); };
  return fmt::format(
      "air: mean free path {:.2g} mm in cells of {:.2g} mm, Knudsen number {:.2g} on the "
      "stand-off, Z = p/nkT = {:.3g}; disturbed {:.2g} m3\n",
      1e3 * at("mean_free_path_m"), 1e3 * at("cell_m"), at("knudsen_number"), at("compressibility_factor"),
      at("awake_volume_m3"));
}

/// Who waited for whom, and what helps: a side is called idle when it waited for more than a quarter of its time.
std::string balance_text(const OrderedJson& record) {
  const auto share = [&](const char* side) {
    const auto at = [&](const char* what) {
      return number_at(record, fmt::format("timing.{}.{}", side, what)).value_or(0.0);
    };
    const double all = at("compute_s") + at("wait_s") + at("exchange_s");
    return all > 0.0 ? at("wait_s") / all : 0.0;
  };
  const double particle = share("particle"), structure = share("structure");
  if (std::max(particle, structure) < 0.25) return "";
  const bool idle_structure = structure > particle;
  const std::string scheme = record.contains("coupling") ? record["coupling"].value("scheme", "") : "";
  const char* advice = scheme == "serial" && std::min(particle, structure) > 0.25
                           ? "coupling.scheme = \"parallel\" lets both compute at once"
                       : idle_structure ? "more --particle-threads, fewer --structure-threads"
                                        : "more --structure-threads, fewer --particle-threads";
  return fmt::format("the {} waited {:.0f} % of its time for the {}: {}\n",
                     idle_structure ? "structure" : "particle side", 100.0 * std::max(particle, structure),
                     idle_structure ? "particles" : "structure", advice);
}

std::string time_text(const OrderedJson& record) {
  Rows rows{{"", "compute", "wait", "exchange", "stages"}};
  for (const char* side : {"particle", "structure"}) {
    if (!record["timing"].contains(side)) continue;
    const OrderedJson& times = record["timing"][side];
    std::string stages;
    if (times.contains("stages"))
      for (const auto& [name, seconds] : times["stages"].items())
        if (seconds.is_number() && seconds.get<double>() >= 0.05)
          stages += (stages.empty() ? "" : ", ") + fmt::format("{} {:.1f}", name, seconds.get<double>());
    const auto seconds = [&](const char* key) { return fmt::format("{:.1f} s", times.value(key, 0.0)); };
    rows.push_back({side, seconds("compute_s"), seconds("wait_s"), seconds("exchange_s"), stages});
  }
  return rows.size() > 1 ? "time\n" + table_text(rows, {false, true, true, true, false}) + balance_text(record) : "";
}

}  // namespace

std::string result_table(const OrderedJson& record, const std::vector<ReferenceValue>& references) {
  const Rows rows = result_rows(record, references);
  std::string text;
  if (rows.size() > 1) text += table_text(rows, {false, true, true, true, false}) + "\n";
  return text + conservation_text(record) + rest_text(record) + air_text(record) + time_text(record);
}

std::vector<std::string> result_warnings(const OrderedJson& record) {
  std::vector<std::string> warnings;
  if (record.contains("relaxation") && !record["relaxation"].value("at_rest", false)) {
    std::string why = record["relaxation"].value("message", "");
    warnings.push_back("the structure did not come to rest: the permanent deflection is not certified" +
                       (why.empty() ? "" : " (" + why + ")"));
  }
  for (const char* key : {"energy_error_particles", "energy_error_structure"})
    if (const auto value = number_at(record, std::string("conservation.") + key); value && !(std::abs(*value) < 0.01))
      warnings.push_back(fmt::format("{} is {}: above 1 % the result is not to be trusted", key, percent(*value)));
  if (const auto value = number_at(record, "conservation.interface_work_error"); value && !(*value < 0.05))
    warnings.push_back(
        fmt::format("interface_work_error is {}: raise the particle counts first, then try another coupling.window",
                    percent(*value)));
  if (const auto value = number_at(record, "conservation.momentum_error"); value && !(*value < 1e-9))
    warnings.push_back(fmt::format("momentum_error is {:.1e}: momentum was lost somewhere", *value));
  return warnings;
}

}  // namespace standoff::launch
