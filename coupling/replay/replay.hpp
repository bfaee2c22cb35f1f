#pragma once
// A recorded side of the interface as a participant: its partner cannot tell it from the one that was recorded. With
// the windows of the tape it sends the recorded bits; with others the load keeps the impulse and the motion its path:
//
//   force over [a, b]   sum of recorded force times overlap / (b - a): the impulse up to any common time is the same
//   motion at t         cubic Hermite between recorded positions and velocities (Hermite 1878), velocity its derivative
#include "coupling/case/case_spec.hpp"
#include "coupling/contract/participant.hpp"
#include "coupling/tape/tape_reader.hpp"

namespace standoff {

class ReplayedSide {
 public:
  ReplayedSide(TapeReader& tape, Role role) : tape_(tape), role_(role) {}

  /// What the side hands in at the end of window k of `clock`. Throws Stop(bad_case) where the tape has ended.
  TapeFrame at(const CouplingClock& clock, std::int64_t window);

 private:
  const TapeFrame& recorded(std::int64_t window);
  TapeFrame load_over(double begin, double end);
  TapeFrame motion_at(double time);

  TapeReader& tape_;
  Role role_;
  std::vector<TapeFrame> near_;  // frames read last, at most two
};

/// What is wrong with replaying a load recorded on `recorded` on `surface`; empty if nothing is. Masses may differ.
std::string surface_objection(const SurfaceMesh& recorded, const SurfaceMesh& surface);

/// The life of a replayed side in a run.
void replay_load(const CaseSpec& spec, TapeReader& tape, Participant& link);
void replay_structure(const CaseSpec& spec, TapeReader& tape, Participant& link);

}  // namespace standoff
