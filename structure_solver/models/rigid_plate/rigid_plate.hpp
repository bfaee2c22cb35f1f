#pragma once
// Model "rigid_plate": the plate as one rigid body. Held by its edges it receives force and moves nowhere: for pure
// load studies. With plate.edges = "free" nothing holds it along z and the load pushes it, M W'' = F, as in the
// pendulum of an impulse test; it does not tilt or slide.
#include "structure_solver/models/shaped_surface.hpp"

namespace standoff::structure {

class RigidPlate final : public StructuralModel {
 public:
  explicit RigidPlate(const CaseSpec& spec);

  const SurfaceMesh& surface() const override { return shaped_.surface(); }
  void surface_motion(SurfaceMotion& motion) const override { shaped_.motion(way_, velocity_, motion); }
  void set_surface_force(std::span<const Vec3> force) override;
  double stable_step() const override { return stable_step_; }
  void step(double dt) override;
  double time() const override { return time_; }
  StructureLedger ledger() const override;
  StructureExtremes extremes() const override { return {}; }
  double centre_deflection() const override { return way_; }
  double max_deflection() const override { return way_; }
  std::vector<ProfilePoint> profile() const override { return shaped_.profile(way_); }
  StructureFrame frame() const override { return shaped_.frame(way_, velocity_); }
  void add_to(StateHash& hash) const override;
  void save(StateWriter& writer) const override { writer(*this); }
  void restore(StateReader& reader) override { reader(*this); }
  double mass() const override { return mass_; }
  template <class Archive>
  void archive(Archive& a) {
    a(time_, force_, push_, impulse_, way_, velocity_, work_);
  }
  long elements() const override { return 0; }
  const StageTimers& timers() const override { return timers_; }

 private:
  bool free_;
  double mass_;         // kg
  double stable_step_;  // s; nothing can become unstable, but the window rule asks for a time
  ShapedSurface shaped_;
  double time_ = 0.0;
  Vec3 force_, impulse_;               // N, N s
  double push_ = 0.0;                  // N, along the way
  double way_ = 0.0, velocity_ = 0.0;  // m, m/s, away from the charge
  double work_ = 0.0;                  // J
  StageTimers timers_;
};

}  // namespace standoff::structure
