#include "coupling/case/case_reader.hpp"

#include <map>

#include "coupling/case/checks.hpp"
#include "coupling/case/derive.hpp"
#include "coupling/case/effects/registry.hpp"
#include "coupling/case/layers.hpp"
#include "coupling/case/periodic_checks.hpp"
#include "coupling/case/plate_checks.hpp"
#include "coupling/case/resolved_text.hpp"

namespace standoff {
namespace {

void decide(CaseSpec& spec, const Settings& settings, Diagnostics& diagnostics) {
  std::map<std::string, bool> stated;
  for (const std::string& name : effect_names())
    if (const std::string word = settings.word("effects." + name); !word.empty()) stated[name] = word == "on";
  EffectDecisions decisions = decide_effects(spec, stated);
  spec.effects = std::move(decisions.effects);
  for (const auto& [name, why] : decisions.unreachable)
    diagnostics.error(settings.blame({"effects." + name}),
                      name + " = \"" + settings.word("effects." + name) + "\" cannot reach the physics: " + why,
                      "leave it out, turn it round, or change what the reason names");
  leave_out_what_is_off(spec);
}

}  // namespace

CaseRead read_case(const std::string& path, const CaseOverrides& overrides) {
  CaseRead result;
  Diagnostics diagnostics;
  Layers layers = read_layers(path, overrides, diagnostics);
  if (layers.readable) {
    Settings& settings = layers.settings;
    settings.add("case.name", {layers.name, "name of the folder", {}, rank::fallback});
    const bool cell = overrides.purpose == CasePurpose::cell ||
                      (overrides.purpose == CasePurpose::either && describes_a_cell(settings));
    if (cell)
      complete_cell(settings, diagnostics);
    else
      complete(settings, diagnostics);
    CaseSpec spec = build_spec(settings);
    spec.folder = layers.folder;
    spec.references = layers.references;
    check_scene(spec, settings, diagnostics);
    check_plate(spec, settings, diagnostics);
    check_periodic_scene(spec, settings, diagnostics);
    if (!diagnostics.any_error()) {
      decide(spec, settings, diagnostics);
      result.resolved = resolved_text(spec, settings);
      result.hash = case_fingerprint(spec, settings);
      result.spec = std::move(spec);
    }
  }
  result.errors = diagnostics.errors();
  result.warnings = diagnostics.warnings();
  return result;
}

}  // namespace standoff
