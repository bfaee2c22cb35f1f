#pragma once
// Gathers every statement of a case: the file, what it uses, the level, the command line. Reports what cannot be read,
// what is unknown and what has the wrong type, unit or range. Meaning is for derive.hpp and checks.hpp.
#include <string>
#include <vector>

#include "coupling/case/case_reader.hpp"
#include "coupling/case/settings.hpp"

namespace standoff {

struct Layers {
  Settings settings;
  std::vector<ReferenceValue> references;
  std::string folder;  // where the case file lies
  std::string name;    // name of that folder, or of a file that is not called case.toml
  std::string level;   // the chosen one, "" if the case has none
  bool readable = false;
};

Layers read_layers(const std::string& case_path, const CaseOverrides& overrides, Diagnostics& diagnostics);

}  // namespace standoff
