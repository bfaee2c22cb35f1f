#pragma once
// What the rules gave, for people and for continuous integration.
#include <string>
#include <vector>

#include "coupling/conform/rules.hpp"

namespace standoff::conform {

/// "PASS  waits_for_grant   computes nothing that was not granted", for a failure the reason below.
std::string verdict_text(const Verdict& verdict);
/// JUnit's XML; `suite` names the participant.
std::string junit_text(const std::string& suite, const std::vector<Verdict>& verdicts);

}  // namespace standoff::conform
