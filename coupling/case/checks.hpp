#pragma once
// What single values cannot show: bodies that overlap, meshes that do not fit the symmetry, times that contradict each
// other. Every finding points at the value stated last among those involved.
#include "coupling/case/case_spec.hpp"
#include "coupling/case/settings.hpp"

namespace standoff {

void check_scene(const CaseSpec& spec, const Settings& settings, Diagnostics& diagnostics);

}  // namespace standoff
