#pragma once
// case.resolved.toml: every value in SI with its origin, itself a case that repeats the run.
#include <string>
#include <vector>

#include "coupling/case/case_spec.hpp"
#include "coupling/case/settings.hpp"

namespace standoff {

std::string resolved_text(const CaseSpec& spec, const Settings& settings);

/// Fingerprint of everything a result depends on: all values and effects, not titles, references or unused levels.
std::string case_fingerprint(const CaseSpec& spec, const Settings& settings);

}  // namespace standoff
