#pragma once
// A stage that one effect adds to the time loop of the particles: its work on the grains, and its books. A scene
// without the effect has no such object: no memory, no timer row, no column.
//
// Called once a step between the first half kick and the drift, when no contact force is pending. What it takes from
// the particles it books, so that energy and momentum of everything stay complete. Name = effect = timer row; its
// column in histories.csv is NAME_loss_J. The same bits for any number of threads.
#include <memory>
#include <vector>

#include "coupling/base/vec3.hpp"
#include "coupling/case/case_spec.hpp"
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

/// Taken from the particles since the start; simulated part.
struct EffectBooks {
  double loss = 0.0;  // J
  Vec3 momentum;      // kg m/s
  template <class Archive>
  void archive(Archive& a) {
    a(loss, momentum);
  }
};

class ParticleEffect {
 public:
  virtual ~ParticleEffect() = default;
  virtual const char* name() const = 0;
  virtual void run(SandState& sand, double h) = 0;
  EffectBooks books;
};

/// registry.cpp: the effects of this kind that are on in a scene with grains.
std::vector<std::unique_ptr<ParticleEffect>> particle_effects(const CaseSpec& spec, int threads);

}  // namespace standoff::particles
