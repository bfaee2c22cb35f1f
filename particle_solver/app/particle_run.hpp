#pragma once
// The life of the particle process: join, receive the surface, fill the scene, follow the windows, hand in the results.
#include <string>

#include "coupling/case/case_spec.hpp"
#include "coupling/contract/participant.hpp"

namespace standoff::particles {

struct ParticleRunOptions {
  std::string out;  // run folder for particles/ and impulse_map.csv; empty writes nothing
  int threads = 1;
};

/// Runs the load side of a coupled case to the end; throws Stop with the first cause.
void run_particles(const CaseSpec& spec, const ParticleRunOptions& options, Participant& link);

}  // namespace standoff::particles
