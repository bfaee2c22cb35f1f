#pragma once
// What a plate or pipe needs: a mesh that fits its mirror planes, edges that its model knows, a metal that can exist.
#include "coupling/case/case_spec.hpp"
#include "coupling/case/settings.hpp"

namespace standoff {

void check_plate(const CaseSpec& spec, const Settings& settings, Diagnostics& diagnostics);

}  // namespace standoff
