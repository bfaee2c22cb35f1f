#pragma once
// Published and measured figures beside which a result is shown: [[references]] in reference.toml or in a resolved
// case.
#include <string>
#include <vector>

#include "coupling/case/case_spec.hpp"
#include "coupling/case/document.hpp"

namespace standoff {

/// Reads the tables of one [[references]] list and appends what is right.
void read_references(const Node& list, std::vector<ReferenceValue>& references, Diagnostics& diagnostics);

/// The list as TOML, in SI.
std::string reference_text(const std::vector<ReferenceValue>& references);

}  // namespace standoff
