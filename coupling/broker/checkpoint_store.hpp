#pragma once
// checkpoint/ of a run folder: the last two checkpoints, each complete or absent.
//
//   checkpoint/window-000001200/  particles.state  structure.state    written by the participants
//                                 interface.state                     what lies between them, written by the broker
//                                 checkpoint.json                     what it is: for people, and to see that it fits
//   checkpoint/window-000001800.part/                                 being written; renamed when all is on disk
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "coupling/session/session.hpp"

namespace standoff {

class CheckpointStore {
 public:
  /// `build` names the program and goes into checkpoint.json. Sweeps.
  CheckpointStore(std::string folder, std::string build);
  /// Removes what was left unfinished.
  void sweep() const;
  /// Adds the broker's half, makes the checkpoint count, and removes all but the last two. Throws
  /// Stop(out_of_resources); the earlier ones are untouched then.
  void commit(const InterfaceState& state) const;

 private:
  std::string folder_, build_;
};

/// Complete checkpoints in `folder`, newest first.
std::vector<std::string> checkpoints_in(const std::string& folder);

/// Reads one; `folder` is its own, window-... Throws Stop(checkpoint_incompatible) if it is damaged.
ResumePoint read_checkpoint(const std::string& folder);

}  // namespace standoff
