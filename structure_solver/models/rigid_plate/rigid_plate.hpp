#pragma once
// Model "rigid_plate": the surface of the plate held still. It receives force and moves nowhere: for pure load studies,
// and the smallest example of a structural model.
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {

class RigidPlate final : public StructuralModel {
 public:
  explicit RigidPlate(const CaseSpec& spec);

  const SurfaceMesh& surface() const override { return surface_; }
  void surface_motion(SurfaceMotion& motion) const override {
    motion.position = surface_.position;
    motion.velocity.assign(surface_.position.size(), Vec3{});
  }
  void set_surface_force(std::span<const Vec3> force) override;
  double stable_step() const override { return stable_step_; }
  void step(double dt) override;
  double time() const override { return time_; }
  StructureLedger ledger() const override;
  StructureExtremes extremes() const override { return {}; }
  double centre_deflection() const override { return 0.0; }
  double max_deflection() const override { return 0.0; }
  std::vector<ProfilePoint> profile() const override;
  StructureFrame frame() const override;
  void add_to(StateHash& hash) const override { hash.add(impulse_); }
  void save(StateWriter& writer) const override { writer(*this); }
  void restore(StateReader& reader) override { reader(*this); }
  double mass() const override { return mass_; }
  template <class Archive>
  void archive(Archive& a) {
    a(time_, force_, impulse_);
  }
  long elements() const override { return 0; }
  const StageTimers& timers() const override { return timers_; }

 private:
  SurfaceMesh surface_;
  bool mirrored_;
  double mass_;         // kg
  int line_nodes_;      // surface nodes along x
  double stable_step_;  // s; nothing can become unstable, but the window rule asks for a time
  double time_ = 0.0;
  Vec3 force_, impulse_;
  StageTimers timers_;
};

}  // namespace standoff::structure
