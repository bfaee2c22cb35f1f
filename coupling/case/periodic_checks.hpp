#pragma once
// What a scene needs so that it can repeat (domain.boundaries = "periodic"): a stated width, room between a particle
// and its own image, a plate that is endless or stands free of its images, and no mirror planes.
#include "coupling/case/case_spec.hpp"
#include "coupling/case/settings.hpp"

namespace standoff {

void check_periodic_scene(const CaseSpec& spec, const Settings& settings, Diagnostics& diagnostics);

}  // namespace standoff
