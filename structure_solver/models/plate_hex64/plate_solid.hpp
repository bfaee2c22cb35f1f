#pragma once
// The plate itself: mesh, motion, history and books, with the explicit step. plate_hex64.hpp shows it to the coupling,
// plate_relaxation.hpp to the relaxation.
#include "coupling/base/stop.hpp"
#include "coupling/case/case_spec.hpp"
#include "structure_solver/mesh/surface_map.hpp"
#include "structure_solver/step/central_difference.hpp"
#include "structure_solver/step/internal_force.hpp"

namespace standoff::structure {

MetalParameters metal_parameters(const MaterialSpec& material);
/// Effects strain_rate, heating, expansion, hardening of the scene.
MetalEffects metal_effects(const CaseSpec& spec);
PlateMeshOptions mesh_options(const CaseSpec& spec);

class PlateSolid {
 public:
  PlateSolid(PlateMesh mesh, const CaseSpec& spec, int threads);
  PlateSolid(const PlateSolid&) = delete;
  PlateSolid& operator=(const PlateSolid&) = delete;

  const PlateMesh& mesh() const { return mesh_; }
  const NodalState& state() const { return state_; }
  const InternalForce& forces() const { return forces_; }
  InternalForce& forces() { return forces_; }
  const PlateBooks& books() const { return books_; }
  PlateBooks& books() { return books_; }
  double elastic() const { return elastic_; }  // J
  double time() const { return time_; }
  int threads() const { return threads_; }
  double stable_step() const { return stable_step_; }

  std::vector<Vec3>& external() { return state_.external; }
  /// The three parts of an explicit step, in order.
  void kick_and_drift_nodes(double dt);
  void update_elements(double dt);
  void kick_nodes(double dt);

  /// Overwrites the motion; the history stays.
  void set_motion(std::span<const Vec3> u, std::span<const Vec3> v);
  /// Makes the state at u the committed one and books its inelastic work.
  void commit(std::span<const Vec3> u, double dt);

  template <class Archive>
  void archive(Archive& a) {
    const std::size_t nodes = state_.u.size(), history = forces_.history_bytes();
    a(state_, forces_, books_, elastic_, time_, stable_step_, last_dt_, steps_);
    if (state_.u.size() != nodes || state_.v.size() != nodes || forces_.history_bytes() != history)
      throw Stop(ExitCode::checkpoint_incompatible,
                 "structure: the saved plate has " + std::to_string(state_.u.size()) + " nodes, this one " +
                     std::to_string(nodes) + ", or other effects\n  a state fits the case that wrote it");
  }

 private:
  Stop broken(const ForceSums& sums) const;
  /// Back to the shape before the drift of this step: the last one without a broken element, for the last frame.
  void step_back(double dt);
  double rest_step();
  double rest_step_of(long first);
  void collect_internal_force();

  PlateMesh mesh_;
  int threads_;
  InternalForce forces_;
  NodalState state_;
  PlateBooks books_;
  double elastic_ = 0.0, time_ = 0.0;
  double rest_step_ = 0.0, stable_step_ = 0.0, last_dt_ = 0.0;
  long steps_ = 0;
};

}  // namespace standoff::structure
