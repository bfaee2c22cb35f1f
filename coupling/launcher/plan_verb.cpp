#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/build_facts.hpp"
#include "coupling/launcher/prediction.hpp"
#include "coupling/launcher/text_format.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {
namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string share(double seconds, const CostPrediction& p) {
  const double part = p.core_s() > 0.0 ? 100.0 * seconds / p.core_s() : 0.0;
  return part < 0.05 ? "-" : fmt::format("{:.1f} %", part);
}

/// "off would save 12.0 s (31 %) and 5.1 MB; grains slide freely".
std::string overriding_text(const EffectPrice& e, const CostPrediction& p) {
  if (!e.overriding) return "";
  const double seconds = e.overriding->seconds, bytes = e.overriding->bytes;
  std::string price;
  if (std::abs(seconds) >= 0.05) price = fmt::format("{:.1f} s ({})", std::abs(seconds), share(std::abs(seconds), p));
  if (std::abs(bytes) >= 1e3) price += (price.empty() ? "" : " and ") + bytes_text(std::abs(bytes));
  const bool saves = seconds < 0.0 || (seconds == 0.0 && bytes < 0.0);
  const std::string verb = price.empty() ? "is free of cost" : (saves ? "would save " : "would take ") + price;
  const std::string turned = e.on ? "off" : e.switched_by.empty() ? "on" : "on (" + e.switched_by + ")";
  return fmt::format("{} {}; without it {}", turned, verb, e.without);
}

std::string effects_text(const CostPrediction& p) {
  Rows rows{{"effect", "", "bytes", "time", "why; what overriding costs"}};
  for (const EffectPrice& e : p.effects) {
    rows.push_back({e.name, e.on ? "on" : "off", e.on && e.bytes > 0.0 ? bytes_text(e.bytes) : "-",
                    e.on ? share(e.seconds, p) : "-", e.reason});
    if (const std::string text = overriding_text(e, p); !text.empty()) rows.push_back({"", "", "", "", "  " + text});
  }
  return "effects\n" + table_text(rows, {false, false, true, true, false});
}

std::string counts_text(const CostPrediction& p) {
  Rows rows{{"", "full", "simulated", "step", "steps"}};
  const auto row = [&](const char* name, long full, double step, double steps) {
    if (full > 0)
      rows.push_back({name, with_separators(full), with_separators(static_cast<long>(p.simulated(full))),
                      step > 0.0 ? duration_text(step) : "",
                      steps > 0.0 ? with_separators(static_cast<long>(steps)) : ""});
  };
  row("charge particles", p.charge_particles, p.gas_step, p.gas_steps);
  row("sand particles", p.sand_particles, p.sand_step, p.sand_steps);
  row("air particles", p.air_particles, 0.0, p.air_steps);
  row("elements", p.elements, p.structure_step, p.structure_steps);
  return "what is computed (steps: stable at the start, and how many in all)\n" +
         table_text(rows, {false, true, true, true, true});
}

std::string price_text(const CostPrediction& p) {
  Rows rows{{"gas", fmt::format("{:.1f} s", p.gas_s), share(p.gas_s, p)},
            {"air", fmt::format("{:.1f} s", p.air_s), share(p.air_s, p)},
            {"sand", fmt::format("{:.1f} s", p.sand_s), share(p.sand_s, p)},
            {"packing of the cell", fmt::format("{:.1f} s", p.packing_s), share(p.packing_s, p)},
            {"structure", fmt::format("{:.1f} s", p.structure_s), share(p.structure_s, p)},
            {"relaxation", fmt::format("{:.1f} s", p.relaxation_s), share(p.relaxation_s, p)},
            {"exchange", fmt::format("{:.1f} s", p.exchange_s), share(p.exchange_s, p)}};
  return "price on one core\n" + table_text(rows, {false, true, true});
}

void print_plan(const CaseSpec& spec, const CostPrediction& p) {
  std::printf("%s%s%s: %s\n", spec.name.c_str(), spec.level.empty() ? "" : ", level ", spec.level.c_str(),
              spec.title.c_str());
  if (!spec.question.empty()) std::printf("question: %s\n", spec.question.c_str());
  std::printf("\n%s\n%s\n%s\n", effects_text(p).c_str(), counts_text(p).c_str(), price_text(p).c_str());
  std::printf("windows: %s of %s (%s scheme)\n", with_separators(static_cast<long>(p.windows)).c_str(),
              duration_text(p.window).c_str(), spec.coupling.scheme == Scheme::parallel ? "parallel" : "serial");
  std::printf("memory: particles %s, structure %s, besides about 30 MB a process\n",
              bytes_text(p.particle_bytes).c_str(), bytes_text(p.structure_bytes).c_str());
  std::printf("threads: particles %d, structure %d\n", p.particle_threads, p.structure_threads);
  std::printf("predicted wall time: %s (within a factor of two)\n", wall_text(p.wall_s).c_str());
}

nlohmann::ordered_json plan_json(const CaseSpec& spec, const CostPrediction& p) {
  nlohmann::ordered_json j{{"case", spec.name}, {"level", spec.level}, {"levels", spec.levels}};
  j["effects"] = nlohmann::ordered_json::array();
  for (const EffectPrice& e : p.effects) {
    j["effects"].push_back({{"name", e.name},
                            {"on", e.on},
                            {"reason", e.reason},
                            {"bytes", e.bytes},
                            {"seconds", e.seconds},
                            {"share", p.core_s() > 0.0 ? e.seconds / p.core_s() : 0.0}});
    if (e.overriding)
      j["effects"].back()["overriding"] = {
          {"bytes", e.overriding->bytes}, {"seconds", e.overriding->seconds}, {"without", e.without}};
  }
  j["counts"] = {{"charge_particles", p.charge_particles},
                 {"sand_particles", p.sand_particles},
                 {"air_particles", p.air_particles},
                 {"elements", p.elements},
                 {"simulated_charge_particles", static_cast<long>(p.simulated(p.charge_particles))},
                 {"simulated_sand_particles", static_cast<long>(p.simulated(p.sand_particles))},
                 {"simulated_air_particles", static_cast<long>(p.simulated(p.air_particles))},
                 {"simulated_elements", static_cast<long>(p.simulated(p.elements))},
                 {"windows", static_cast<long>(p.windows)}};
  j["steps"] = {{"gas_step_s", p.gas_step}, {"sand_step_s", p.sand_step}, {"structure_step_s", p.structure_step},
                {"gas_steps", p.gas_steps}, {"sand_steps", p.sand_steps}, {"structure_steps", p.structure_steps}};
  j["window_s"] = p.window;
  j["memory"] = {{"particle_bytes", p.particle_bytes}, {"structure_bytes", p.structure_bytes}};
  j["core_seconds"] = {{"gas", p.gas_s},
                       {"sand", p.sand_s},
                       {"packing", p.packing_s},
                       {"structure", p.structure_s},
                       {"relaxation", p.relaxation_s},
                       {"exchange", p.exchange_s}};
  j["threads"] = {{"particles", p.particle_threads}, {"structure", p.structure_threads}};
  j["predicted_wall_s"] = p.wall_s;
  return j;
}

}  // namespace

int plan_verb(const PlanOptions& options) {
  const CaseRead read = read_case(options.case_path, options.overrides);
  if (!print_diagnostics(read)) return static_cast<int>(ExitCode::bad_case);
  const CostPrediction p =
      predict_cost(read.spec, usable_cores(), options.threads.particle_count(), options.threads.structure_count());
  if (options.json)
    std::printf("%s\n", plan_json(read.spec, p).dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  else
    print_plan(read.spec, p);
  return static_cast<int>(ExitCode::done);
}

}  // namespace standoff::launch
