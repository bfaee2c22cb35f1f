#pragma once
// The run of a case whose model is a material point: the structure program alone draws flow curves; no broker, no
// particles.
#include <string>

#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

/// Writes case.resolved.toml, flow_curves.csv, flow_curves.svg and run.json into `folder`; returns the exit code.
int run_point(const RunOptions& options, const CaseRead& read, const std::string& folder);

}  // namespace standoff::launch
