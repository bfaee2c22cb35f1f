#pragma once
// Every effect that exists, with the rule by which a scene calls for it. A rule is a physical criterion and gives its
// reason as a sentence with numbers; [effects] of a case overrides it.
#include <map>
#include <string>
#include <vector>

#include "coupling/case/case_spec.hpp"

namespace standoff {

/// What a rule finds in a scene.
struct EffectFinding {
  bool possible = true;  // false: the scene holds nothing this effect could act on; it cannot be switched on
  bool wanted = false;   // what the criterion says
  std::string reason;
};

struct EffectRule {
  std::string name, doc;
  EffectFinding (*find)(const CaseSpec&);
};

const std::vector<EffectRule>& effect_rules();
const std::vector<std::string>& effect_names();

struct EffectDecisions {
  std::vector<EffectDecision> effects;  // in the order of the rules
  std::vector<std::string> idle;        // switched on by the case although there is nothing to act on: they stay off
};

/// `stated`: effect name to on or off, from [effects].
EffectDecisions decide_effects(const CaseSpec& spec, const std::map<std::string, bool>& stated);

}  // namespace standoff
