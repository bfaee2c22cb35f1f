#pragma once
// The plate itself: mesh, motion, history and books, with the explicit step. plate_shell.hpp shows it to the coupling,
// shell_relaxation.hpp to the relaxation.
#include "coupling/base/stop.hpp"
#include "coupling/case/case_spec.hpp"
#include "structure_solver/models/plate_shell/shell_force.hpp"
#include "structure_solver/step/central_difference.hpp"

namespace standoff::structure {

class ShellPlate {
 public:
  ShellPlate(const CaseSpec& spec, int threads);
  ShellPlate(const ShellPlate&) = delete;
  ShellPlate& operator=(const ShellPlate&) = delete;

  const ShellMesh& mesh() const { return mesh_; }
  const NodalState& translation() const { return translation_; }
  const NodalState& slip() const { return slip_; }  // of the face against the mid-surface, see director.hpp
  const ShellForce& forces() const { return forces_; }
  ShellForce& forces() { return forces_; }
  const PlateBooks& books() const { return books_; }
  PlateBooks& books() { return books_; }
  double elastic() const { return elastic_; }  // J
  double kinetic() const;
  double time() const { return time_; }
  double stable_step() const { return stable_step_; }

  std::vector<Vec3>& external() { return translation_.external; }
  /// The three parts of an explicit step, in order.
  void kick_and_drift_nodes(double dt);
  void update_elements(double dt);
  void kick_nodes(double dt);

  /// Displacement and slip, or their velocities, of all nodes.
  struct Nodal {
    std::vector<Vec3> u, slip;
  };
  /// Overwrites the motion; the history stays.
  void set_motion(const Nodal& at, const Nodal& velocity);
  /// Makes the state at `at` the committed one and books its inelastic work.
  void commit(const Nodal& at, double dt);

  template <class Archive>
  void archive(Archive& a) {
    const std::size_t nodes = translation_.u.size(), history = forces_.history_bytes();
    a(translation_, slip_, forces_, books_, elastic_, time_, stable_step_, last_dt_, steps_);
    if (translation_.u.size() != nodes || slip_.u.size() != nodes || forces_.history_bytes() != history)
      throw Stop(ExitCode::checkpoint_incompatible,
                 "structure: the saved plate has " + std::to_string(translation_.u.size()) + " nodes, this one " +
                     std::to_string(nodes) + ", or other effects\n  a state fits the case that wrote it");
  }

 private:
  Stop broken(const ForceSums& sums) const;
  void book(const HalfStepSums& sums);
  /// Back to the shape before the drift of this step: the last one without a broken element, for the last frame.
  void step_back(double dt);
  double rest_step();
  void collect_internal_force();
  /// Checks the element forces just evaluated and books them.
  void take(const ForceSums& sums);

  ShellMesh mesh_;
  int threads_;
  ShellForce forces_;
  NodalState translation_, slip_;
  PlateBooks books_;
  double elastic_ = 0.0, time_ = 0.0;
  double rest_step_ = 0.0, stable_step_ = 0.0, last_dt_ = 0.0;
  long steps_ = 0;
};

}  // namespace standoff::structure
