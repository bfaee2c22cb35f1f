#pragma once
// Stage hard_core: grains that are pressed deeper than half a radius and still approach bounce off each other.
//
//   ... -> sand_pairs -> sand_integrate (second half kick) -> hard_core
//
// After the second half kick, because only then velocities belong to the positions at which overlaps were measured. The
// deep contacts are collected by block in parallel and resolved one after the other in the order of the lists, each
// with the velocities as the ones before left them: the same bits for any number of threads. One sweep a step: what
// closes again is met in the next step. Law: kernels/hard_core.hpp.
//
// A grain thrown by gas is fast: `longest_step` keeps a pair from moving by more than a radius against each other
// within a step, so that from outside the core (1.5 r) nobody reaches the other side of a centre.
#include <vector>

#include "particle_solver/state/media.hpp"
#include "particle_solver/step/sand_pairs.hpp"

namespace standoff::particles {

struct HardCoreCounts {
  long hits = 0;        // impulses given
  Vec3 mirror_impulse;  // N s given to the mirror planes
};

class HardCore {
 public:
  /// `pairs` must stand at the positions of `sand`: call right after the half kick that follows pairs.forces.
  HardCoreCounts run(SandState& sand, SandPairs& pairs);
  /// Half the smallest radius over the largest speed [s]; infinite for grains at rest.
  static double longest_step(const SandState& sand);

 private:
  std::vector<DeepContact> contacts_;
};

}  // namespace standoff::particles
