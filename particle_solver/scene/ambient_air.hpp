#pragma once
// Ambient air of a scene: how it is resolved, and where it stands at the start (everywhere, asleep).
#include <memory>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/state/air.hpp"

namespace standoff::particles {

/// Air around the scene, all asleep. `internal_energy` off: gamma 5/3 at the same pressure.
std::unique_ptr<Air> build_air(const CaseSpec& spec);

}  // namespace standoff::particles
