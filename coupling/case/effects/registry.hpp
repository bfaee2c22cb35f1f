#pragma once
// Every effect that exists: one line each, in the order in which they are told.
#include <map>
#include <vector>

#include "coupling/case/effects/effect.hpp"

// clang-format off
#define STANDOFF_EFFECTS(X) \
  X(detonation_timing) \
  X(internal_energy) \
  X(co_volume) \
  X(air) \
  X(ambient_pressure) \
  X(friction) \
  X(grain_rotation) \
  X(damping) \
  X(radius_spread) \
  X(hard_core) \
  X(air_drag) \
  X(drop_outgoing) \
  X(symmetry) \
  X(surface_recession) \
  X(plasticity) \
  X(hardening) \
  X(strain_rate) \
  X(heating) \
  X(expansion) \
  X(large_deformation) \
  X(relaxation) \
  X(energy_audit)
// clang-format on

namespace standoff {

const std::vector<Effect>& effect_rules();
const std::vector<std::string>& effect_names();

struct EffectDecisions {
  std::vector<EffectDecision> effects;  // in the order of the rules
  // Overrides that cannot reach the physics, with the reason: on with nothing to act on, or off where it is inherent.
  std::map<std::string, std::string> unreachable;
};

/// `stated`: effect name to on or off, from [effects].
EffectDecisions decide_effects(const CaseSpec& spec, const std::map<std::string, bool>& stated);
/// Takes what is off out of the specification, so that nothing of it reaches a solver.
void leave_out_what_is_off(CaseSpec& spec);

}  // namespace standoff
