#pragma once
// What the particle process remembers of a run for its history rows and its part of run.json.
#include <optional>

#include <nlohmann/json.hpp>

#include "coupling/case/case_spec.hpp"
#include "coupling/contract/participant.hpp"
#include "particle_solver/ledger/particle_ledger.hpp"
#include "particle_solver/scene/scene.hpp"
#include "particle_solver/scene/shock_arrival.hpp"
#include "particle_solver/step/time_loop.hpp"

namespace standoff::particles {

class ParticleBooks {
 public:
  ParticleBooks(const CaseSpec& spec, const Scene& scene, const TimeLoop& loop);

  /// After every window.
  void observe(double time);
  /// Throws Stop(guard) if particles have passed through the plate.
  void guard(double time, double window) const;
  /// Reads the ledger and returns the columns of histories.csv that the particles know, full domain.
  NamedValues sample(double time);
  /// For the progress line.
  NamedValues progress(double time, long window, long windows) const;
  /// Nested as in run.json.
  nlohmann::json report(const Participant::Times& times) const;
  template <class Archive>
  void archive(Archive& a) {
    a(ledger_);
    if (shock_) a(*shock_);
  }

 private:
  const CaseSpec& spec_;
  const Scene& scene_;
  const TimeLoop& loop_;
  ParticleLedger ledger_;
  std::optional<ShockArrival> shock_;
};

}  // namespace standoff::particles
