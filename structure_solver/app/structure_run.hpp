#pragma once
// The life of the structure process: join, follow the windows, come to rest, hand in the results.
#include <string>

#include "coupling/case/case_spec.hpp"
#include "coupling/contract/participant.hpp"

namespace standoff::structure {

struct StructureRunOptions {
  std::string out;  // run folder for plate/, profile.csv; empty writes nothing
  int threads = 1;
};

/// Runs the plate side of a coupled case to the end; throws Stop with the first cause.
void run_structure(const CaseSpec& spec, const StructureRunOptions& options, Participant& link);

}  // namespace standoff::structure
