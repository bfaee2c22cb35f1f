#pragma once
// The usual course of a run, step by step, so that a rule only states where it departs from it.
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "coupling/case/case_spec.hpp"
#include "coupling/conform/counterpart.hpp"
#include "coupling/contract/surface.hpp"

namespace standoff::conform {

/// What is judged and with which case.
struct Subject {
  std::vector<std::string> command;
  std::string case_file;  // resolved
  CaseSpec spec;
};

class Play {
 public:
  explicit Play(const Subject& given) : subject(given), peer(given.command, given.case_file) {}

  // One step each; each throws RuleBroken if the participant does not take it.
  void hello();
  void welcome(double beat_deadline = 5.0, const Counterpart::Spoil& spoil = nullptr);
  void surface();  // SURFACE from the structure, or to the load side
  void ready();
  void start(std::int64_t count);
  /// START of a run that is continued from the state `saved` in `folder`.
  void start_again(std::int64_t count, const std::string& folder, const message::Saved& saved);
  /// Up to START.
  void begin(std::int64_t count = 1000, double beat_deadline = 5.0);
  /// GRANT of window k with the usual field, or the one given.
  void grant(std::int64_t k, bool drain = false, const Counterpart::Spoil& spoil = nullptr);
  void grant_with(std::int64_t k, const Payload& payload, const Counterpart::Spoil& spoil = nullptr);
  /// ADVANCE of window k, checked and kept in `motion` or `load`.
  void advance(std::int64_t k);
  void stop();
  /// REPORT, BYE, BYE_ACK, exit status 0.
  void goodbye();

  /// A folder that is gone when this play is over.
  std::string scratch_folder() const { return scratch.path(); }
  bool is_structure() const { return role == Role::structure; }
  /// The usual field: a gentle load on the structure, the surface at rest to the load side.
  Payload usual_field(std::int64_t k) const;
  std::vector<Vec3> usual_force(std::int64_t k) const;

  const Subject& subject;
  const launch::PrivateFolder scratch;
  Counterpart peer;
  Role role = Role::load;
  bool keeps = false;  // takes part in checkpoints
  SurfaceMesh mesh;
  std::string digest;
  double window = 0.0;  // s
  WindowNeeds needs;
  InterfaceTotals totals;
  SurfaceMotion motion;
  SurfaceLoad load;
  nlohmann::json report;
};

}  // namespace standoff::conform
