#pragma once
// Case files to CaseSpec: TOML, includes, levels, --set, units, all mistakes at once.
#include <string>
#include <utility>
#include <vector>

#include "coupling/case/case_spec.hpp"

namespace standoff {

/// What a case is read for. A unit cell needs the soil alone: whatever else the case states is left out.
enum class CasePurpose { scene, cell, either };

/// What the command line adds to a case file. Precedence: preset < use < case < level < set < the named options.
struct CaseOverrides {
  std::string level;                                     // "" = the case's own choice
  std::vector<std::pair<std::string, std::string>> set;  // key, value as typed: --set plate.size="..." or run.until=2ms
  std::string structure_model;                           // "" = as in the case
  std::string seed;                                      // "" = as in the case
  CasePurpose purpose = CasePurpose::scene;              // either: a cell if the case has [cell] and no [plate]
};

struct CaseRead {
  CaseSpec spec;                    // valid only if errors is empty
  std::vector<std::string> errors;  // each "file:line:column: error: ..." possibly with indented hint lines
  std::vector<std::string> warnings;
  std::string
      resolved;      // text of case.resolved.toml: every value in SI with its origin; reading it gives the same spec
  std::string hash;  // fingerprint of all resolved inputs
};

/// Reads CASE (a folder with case.toml, or a file). Never throws for a wrong case; every mistake is in `errors`.
CaseRead read_case(const std::string& path, const CaseOverrides& overrides = {});

}  // namespace standoff
