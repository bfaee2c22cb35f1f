#include "coupling/launcher/effect_study.hpp"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/effects/registry.hpp"
#include "coupling/launcher/cost_study.hpp"
#include "coupling/launcher/report_script.hpp"
#include "coupling/launcher/run_folder.hpp"
#include "coupling/launcher/text_format.hpp"
#include "coupling/output/atomic_file.hpp"

namespace standoff::launch {
namespace {

CaseRead read_with(const CostOptions& options, const std::string& level, const std::string& seed,
                   const EffectVariant& variant) {
  CaseOverrides overrides = options.overrides;
  overrides.level = level, overrides.seed = seed;
  if (!variant.effect.empty()) overrides.set.push_back(variant.set);
  return read_case(options.case_path, overrides);
}

std::string change(const Spread& d, double factor, const char* unit) {
  if (d.count == 0 || std::isnan(d.mean)) return "-";
  if (d.count < 2) return fmt::format("{:+.2f} {}", d.mean * factor, unit);
  return fmt::format("{:+.2f} ± {:.2f} {}", d.mean * factor, d.standard_error() * factor, unit);
}

std::string title_of(const EffectVariant& variant) {
  return variant.effect.empty() ? "as it is" : variant.effect + (variant.on ? " on" : " off");
}

/// Level of the study: the first named, else the first of the case.
std::string level_of(const CostOptions& options, const CaseSpec& spec) {
  if (!options.levels.empty()) return options.levels.front();
  return spec.levels.empty() ? "" : spec.levels.front();
}

}  // namespace

std::vector<EffectVariant> effect_variants(const CostOptions& options, const std::string& level) {
  const CaseRead plain = read_with(options, level, "", {});
  if (!print_diagnostics(plain)) throw Stop(ExitCode::bad_case, "the case is wrong, see above");
  std::vector<EffectVariant> variants{{}};
  for (const Effect& effect : effect_rules()) {
    const bool on = !plain.spec.effect(effect.name);
    EffectVariant variant{effect.name, on, {std::string("effects.") + effect.name, on ? "on" : "off"}};
    if (on && effect.switched_by != nullptr) variant.set = {effect.switched_by, "on"};
    const CaseRead turned = read_with(options, level, "", variant);
    if (turned.errors.empty() && turned.spec.effect(effect.name) == on) variants.push_back(variant);
  }
  return variants;
}

EffectDifference paired_difference(const std::vector<CostRun>& turned, const std::vector<CostRun>& as_it_is) {
  const auto difference = [&](double CostRun::*quantity) {
    std::vector<double> values;
    for (std::size_t k = 0; k < std::min(turned.size(), as_it_is.size()); ++k)
      if (turned[k].exit_code == 0 && as_it_is[k].exit_code == 0)
        values.push_back(turned[k].*quantity - as_it_is[k].*quantity);
    return spread_of(values);
  };
  return {difference(&CostRun::processor_s), difference(&CostRun::permanent_m), difference(&CostRun::peak_m),
          difference(&CostRun::impulse_Ns)};
}

std::string effect_table(const std::vector<EffectRuns>& all) {
  std::vector<std::vector<std::string>> rows{
      {"effect turned", "runs", "CPU s", "permanent deflection", "peak deflection", "impulse"}};
  for (const EffectRuns& one : all) {
    if (one.variant.effect.empty()) continue;
    const EffectDifference d = paired_difference(one.runs, all.front().runs);
    rows.push_back({title_of(one.variant), std::to_string(d.processor_s.count), change(d.processor_s, 1.0, "s"),
                    change(d.permanent, 1e3, "mm"), change(d.peak, 1e3, "mm"), change(d.impulse, 1.0, "N s")});
  }
  return "change against the case as it is, same seeds, mean ± standard error\n" +
         table_text(rows, {false, true, true, true, true, true});
}

std::string effect_csv(const std::vector<EffectRuns>& all) {
  std::string text =
      "effect,turned,seed,exit_code,wall_s,permanent_centre_deflection_m,peak_centre_deflection_m,impulse_Ns,cpu_s\n";
  const auto number = [](double value) { return std::isnan(value) ? std::string() : fmt::format("{:.9g}", value); };
  for (const EffectRuns& one : all)
    for (const CostRun& run : one.runs)
      text += fmt::format("{},{},{},{},{},{},{},{},{}\n", one.variant.effect,
                          one.variant.effect.empty() ? "" : (one.variant.on ? "on" : "off"), run.seed, run.exit_code,
                          number(run.seconds), number(run.permanent_m), number(run.peak_m), number(run.impulse_Ns),
                          number(run.processor_s));
  return text;
}

int effect_cost_verb(const CostOptions& options) {
  const CaseRead plain = read_with(options, options.levels.empty() ? "" : options.levels.front(), "", {});
  if (!print_diagnostics(plain)) return static_cast<int>(ExitCode::bad_case);
  const std::string level = level_of(options, plain.spec);
  const std::vector<EffectVariant> variants = effect_variants(options, level);
  const std::string folder = options.out.empty()
                                 ? numbered_folder("runs/" + file_name_of(plain.spec.name), "cost-effects")
                                 : ensured_folder(options.out);
  std::printf("%s: %zu effects can be turned round, %d seeds each, in %s\n", plain.spec.name.c_str(),
              variants.size() - 1, options.seeds, folder.c_str());
  std::vector<EffectRuns> all;
  bool good = true;
  for (const EffectVariant& variant : variants) {
    all.push_back({variant, {}});
    CostOptions one = options;
    if (!variant.effect.empty()) one.overrides.set.push_back(variant.set);
    for (int k = 0; k < options.seeds; ++k) {
      const std::uint64_t seed = plain.spec.run.seed + static_cast<std::uint64_t>(k);
      const PlannedRun planned{level, seed, read_with(options, level, std::to_string(seed), variant).hash, 0.0};
      const std::string title = fmt::format("{} seed {}", title_of(variant), seed);
      if (const auto cause = make_run(one, planned, title, folder, all.back().runs)) {
        std::fprintf(stderr, "standoff: %s; the same command with --out %s continues the study\n", cause->what.c_str(),
                     folder.c_str());
        return static_cast<int>(cause->code);
      }
      good = good && all.back().runs.back().exit_code == 0;
    }
    write_atomically(folder + "/cost-effects.csv", effect_csv(all));
  }
  std::printf("\n%s\n%s/cost-effects.csv\n", effect_table(all).c_str(), folder.c_str());
  std::fflush(stdout);
  if (const std::string trouble = run_report_script("cost_effects_figure.py", {folder}); !trouble.empty())
    std::printf("no figure was drawn: %s\n", trouble.c_str());
  return static_cast<int>(good ? ExitCode::done : ExitCode::check_failed);
}

}  // namespace standoff::launch
