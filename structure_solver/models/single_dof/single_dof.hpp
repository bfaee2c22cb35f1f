#pragma once
// Model "single_dof": the plate as one spring, mass and yield, after Biggs and Jones (equivalent_plate.hpp, sheet.hpp).
#include "structure_solver/models/shaped_surface.hpp"
#include "structure_solver/models/single_dof/plate_spring.hpp"

namespace standoff::structure {

class SingleDof final : public StructuralModel {
 public:
  explicit SingleDof(const CaseSpec& spec);

  const SurfaceMesh& surface() const override { return shaped_.surface(); }
  void surface_motion(SurfaceMotion& motion) const override { shaped_.motion(motion_.w, motion_.velocity, motion); }
  void set_surface_force(std::span<const Vec3> force) override;
  double stable_step() const override;
  void step(double dt) override;
  double time() const override { return time_; }
  StructureLedger ledger() const override;
  StructureExtremes extremes() const override;
  double centre_deflection() const override { return motion_.w; }
  double max_deflection() const override { return motion_.w; }
  std::vector<ProfilePoint> profile() const override { return shaped_.profile(motion_.w); }
  StructureFrame frame() const override { return shaped_.frame(motion_.w, motion_.velocity); }
  void add_to(StateHash& hash) const override;
  void save(StateWriter& writer) const override { writer(*this); }
  void restore(StateReader& reader) override { reader(*this); }
  double mass() const override { return 3.0 * plate().momentum; }
  template <class Archive>
  void archive(Archive& a) {
    std::size_t nodes = surface().position.size();
    a(nodes, motion_, time_, push_, force_, received_, strain_mark_, mark_time_, max_strain_rate_);
    refuse_other(nodes);
  }
  long elements() const override { return 1; }
  const StageTimers& timers() const override { return timers_; }
  RelaxationProblem* relaxation() override { return &motion_; }
  const EquivalentPlate& plate() const { return motion_.spring.plate(); }

 private:
  void refuse_other(std::size_t nodes) const;
  void watch_strain_rate();

  double room_temperature_;  // K
  double longest_step_;      // s
  SpringMotion motion_;
  ShapedSurface shaped_;
  double time_ = 0.0;      // s
  double push_ = 0.0;      // N, load on the deflection
  Vec3 force_, received_;  // N, N s: the whole load
  double strain_mark_ = 0.0, mark_time_ = 0.0, max_strain_rate_ = 0.0;
  StageTimers timers_;
};

}  // namespace standoff::structure
