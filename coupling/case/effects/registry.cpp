#include "coupling/case/effects/registry.hpp"

#include <algorithm>
#include <stdexcept>

namespace standoff {
namespace effects {
#define STANDOFF_DECLARE(name) Effect name();
STANDOFF_EFFECTS(STANDOFF_DECLARE)
#undef STANDOFF_DECLARE
}  // namespace effects

const std::vector<Effect>& effect_rules() {
#define STANDOFF_MAKE(name) effects::name(),
  static const std::vector<Effect> rules{STANDOFF_EFFECTS(STANDOFF_MAKE)};
#undef STANDOFF_MAKE
  return rules;
}

const std::vector<std::string>& effect_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Effect& rule : effect_rules()) list.emplace_back(rule.name);
    return list;
  }();
  return names;
}

namespace {

/// Without air there is no ambient pressure, without plastic flow nothing hardens. An effect stands after what it
/// needs.
void leave_out_what_lacks_its_ground(std::vector<EffectDecision>& effects) {
  const auto named = [&](std::string_view name) { return std::ranges::find(effects, name, &EffectDecision::name); };
  for (const Effect& rule : effect_rules())
    if (EffectDecision& effect = *named(rule.name); effect.on && rule.needs != nullptr && !named(rule.needs)->on)
      effect.on = false, effect.reason = std::string(rule.needs) + " is off";
}

EffectDecision decide(const Effect& rule, const CaseSpec& spec, const bool* stated, EffectDecisions& decisions) {
  const EffectFinding finding = rule.find(spec);
  EffectDecision decision{rule.name, finding.possible && finding.wanted, finding.reason, stated != nullptr};
  if (stated == nullptr) return decision;
  decision.on = *stated;
  decision.reason = "stated by the case; " + finding.reason;
  if (*stated && !finding.possible) decisions.unreachable[rule.name] = finding.reason;
  if (!*stated && rule.inherent && finding.possible && finding.wanted) decisions.unreachable[rule.name] = rule.without;
  return decision;
}

}  // namespace

EffectDecisions decide_effects(const CaseSpec& spec, const std::map<std::string, bool>& stated) {
  EffectDecisions decisions;
  for (const Effect& rule : effect_rules()) {
    const auto it = stated.find(rule.name);
    decisions.effects.push_back(decide(rule, spec, it != stated.end() ? &it->second : nullptr, decisions));
  }
  leave_out_what_lacks_its_ground(decisions.effects);
  return decisions;
}

void leave_out_what_is_off(CaseSpec& spec) {
  for (const Effect& rule : effect_rules())
    if (rule.leave_out != nullptr && !spec.effect(rule.name)) rule.leave_out(spec);
}

bool CaseSpec::effect(const std::string& effect_name) const {
  for (const EffectDecision& decision : effects)
    if (decision.name == effect_name) return decision.on;
  throw std::out_of_range("there is no effect named " + effect_name);
}

}  // namespace standoff
