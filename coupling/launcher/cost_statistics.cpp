#include "coupling/launcher/cost_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "coupling/launcher/text_format.hpp"

namespace standoff::launch {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Spread spread_over(const std::vector<CostRun>& runs, const std::string& level, double CostRun::*quantity) {
  std::vector<double> values;
  for (const CostRun& run : runs)
    if (run.level == level && run.exit_code == 0) values.push_back(run.*quantity);
  return spread_of(values);
}

void compare(LevelError& error, const LevelError& finest) {
  error.difference = error.own.mean - finest.own.mean;
  error.standard_error = &error == &finest ? 0.0 : std::hypot(error.own.standard_error(), finest.own.standard_error());
}

std::string spread_text(const Spread& s, double factor, const char* unit) {
  if (s.count == 0) return "-";
  const std::string mean = fmt::format("{:.2f}", s.mean * factor);
  return s.count < 2 ? mean + unit : fmt::format("{} ± {:.2f}{}", mean, s.deviation * factor, unit);
}

std::string error_text(const LevelError& e, const LevelError& finest) {
  if (!std::isfinite(e.difference) || finest.own.mean == 0.0) return "-";
  if (&e == &finest) return "finest";
  const double percent = 100.0 / std::abs(finest.own.mean);
  const std::string difference = fmt::format("{:+.1f}", e.difference * percent);
  return std::isfinite(e.standard_error) ? fmt::format("{} ± {:.1f} %", difference, e.standard_error * percent)
                                         : difference + " %";
}

const LevelCost* finest_of(const std::vector<LevelCost>& costs) {
  const LevelCost* finest = nullptr;
  for (const LevelCost& cost : costs)
    if (cost.runs > 0) finest = &cost;
  return finest;
}

/// What levels are judged by: the permanent deflection, or the peak where nothing was brought to rest.
LevelError LevelCost::*judged(const LevelCost& finest) {
  return finest.permanent.own.count > 0 ? &LevelCost::permanent : &LevelCost::peak;
}

std::string field(double value) {
  return std::isfinite(value) ? fmt::format("{:.10g}", value) : "";
}

}  // namespace

CostRun::CostRun()
    : permanent_m(unknown),
      maximum_m(unknown),
      peak_m(unknown),
      impulse_Ns(unknown),
      seconds(unknown),
      processor_s(unknown),
      energy_error_particles(unknown),
      energy_error_structure(unknown) {}
Spread::Spread() : mean(unknown), deviation(unknown) {}
LevelError::LevelError() : difference(unknown), standard_error(unknown) {}

double Spread::standard_error() const {
  return deviation / std::sqrt(static_cast<double>(count));
}

Spread spread_of(const std::vector<double>& values) {
  Spread s;
  double sum = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) sum += v, ++s.count;
  if (s.count == 0) return s;
  s.mean = sum / s.count;
  double squares = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) squares += (v - s.mean) * (v - s.mean);
  if (s.count > 1) s.deviation = std::sqrt(squares / (s.count - 1));
  return s;
}

std::vector<LevelCost> level_costs(const std::vector<CostRun>& runs, const std::vector<std::string>& levels) {
  std::vector<LevelCost> costs;
  for (const std::string& level : levels) {
    LevelCost cost;
    cost.level = level;
    for (const CostRun& run : runs)
      if (run.level == level) ++(run.exit_code == 0 ? cost.runs : cost.failed);
    cost.permanent.own = spread_over(runs, level, &CostRun::permanent_m);
    cost.maximum.own = spread_over(runs, level, &CostRun::maximum_m);
    cost.peak.own = spread_over(runs, level, &CostRun::peak_m);
    cost.impulse.own = spread_over(runs, level, &CostRun::impulse_Ns);
    cost.seconds = spread_over(runs, level, &CostRun::seconds);
    cost.processor_s = spread_over(runs, level, &CostRun::processor_s);
    if (cost.runs + cost.failed > 0) costs.push_back(cost);
  }
  const LevelCost* finest = finest_of(costs);
  if (finest == nullptr) return costs;
  for (LevelCost& cost : costs) {
    compare(cost.permanent, finest->permanent);
    compare(cost.maximum, finest->maximum);
    compare(cost.peak, finest->peak);
    compare(cost.impulse, finest->impulse);
  }
  return costs;
}

std::string level_for_error(const std::vector<LevelCost>& costs, double wanted) {
  std::string best;
  double best_seconds = std::numeric_limits<double>::infinity();
  const LevelCost* finest = finest_of(costs);
  if (finest == nullptr || std::count_if(costs.begin(), costs.end(), [](const LevelCost& c) { return c.runs > 0; }) < 2)
    return "";
  LevelError LevelCost::*const quantity = judged(*finest);
  const double limit = wanted * std::abs((finest->*quantity).own.mean);
  for (const LevelCost& cost : costs) {
    const LevelError& error = cost.*quantity;
    if (std::abs(error.difference) + 2.0 * error.standard_error <= limit && cost.seconds.mean < best_seconds)
      best = cost.level, best_seconds = cost.seconds.mean;
  }
  return best;
}

std::string cost_table(const std::vector<LevelCost>& costs) {
  std::vector<std::vector<std::string>> rows{{"level", "runs", "permanent mm", "error", "profile max mm", "peak mm",
                                              "error", "impulse N s", "error", "seconds", "CPU s"}};
  const LevelCost* finest = finest_of(costs);
  for (const LevelCost& c : costs) {
    const std::string runs = c.failed > 0 ? fmt::format("{} ({} failed)", c.runs, c.failed) : std::to_string(c.runs);
    if (c.runs == 0) {
      rows.push_back({c.level, runs});
      continue;
    }
    rows.push_back({c.level, runs, spread_text(c.permanent.own, 1e3, ""), error_text(c.permanent, finest->permanent),
                    spread_text(c.maximum.own, 1e3, ""), spread_text(c.peak.own, 1e3, ""),
                    error_text(c.peak, finest->peak), spread_text(c.impulse.own, 1.0, ""),
                    error_text(c.impulse, finest->impulse), spread_text(c.seconds, 1.0, ""),
                    spread_text(c.processor_s, 1.0, "")});
  }
  std::string text = table_text(rows, {false, true, true, true, true, true, true, true, true, true, true});
  text += "\n  mean ± spread over seeds; error against the finest level that was run ± its standard error\n";
  for (const double wanted : {0.1, 0.05, 0.02}) {
    const std::string level = level_for_error(costs, wanted);
    text += fmt::format("  {} deflection within {:.0f} % of the finest (two standard errors): {}\n",
                        finest != nullptr && judged(*finest) == &LevelCost::peak ? "peak" : "permanent", 100.0 * wanted,
                        level.empty() ? "not shown by these runs" : "level " + level);
  }
  return text;
}

std::string cost_csv(const std::vector<CostRun>& runs) {
  std::string text =
      "level,seed,exit_code,charge_particles,sand_particles,elements,permanent_centre_deflection_m,"
      "permanent_max_deflection_m,peak_centre_deflection_m,impulse_Ns,wall_s,energy_error_particles,"
      "energy_error_structure,cpu_s\n";
  for (const CostRun& r : runs)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.level, r.seed, r.exit_code, r.charge_particles,
                        r.sand_particles, r.elements, field(r.permanent_m), field(r.maximum_m), field(r.peak_m),
                        field(r.impulse_Ns), field(r.seconds), field(r.energy_error_particles),
                        field(r.energy_error_structure), field(r.processor_s));
  return text;
}

}  // namespace standoff::launch
