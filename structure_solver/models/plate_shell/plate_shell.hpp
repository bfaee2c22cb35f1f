#pragma once
// Model "plate_shell": a plate of 4-node shells (MITC4) with five layers, Johnson-Cook metal in plane stress, explicit
// central differences.
#include "structure_solver/models/plate_shell/shell_relaxation.hpp"
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {

class PlateShell final : public StructuralModel {
 public:
  PlateShell(const CaseSpec& spec, int threads);

  const SurfaceMesh& surface() const override { return surface_; }
  void surface_motion(SurfaceMotion& motion) const override;
  void set_surface_force(std::span<const Vec3> force) override;
  double stable_step() const override { return plate_.stable_step(); }
  void step(double dt) override;
  double time() const override { return plate_.time(); }
  StructureLedger ledger() const override;
  StructureExtremes extremes() const override;
  double centre_deflection() const override { return probes_.centre_deflection(plate_.translation().u); }
  double max_deflection() const override { return probes_.max_deflection(plate_.translation().u); }
  std::vector<ProfilePoint> profile() const override { return probes_.profile(plate_.translation().u); }
  StructureFrame frame() const override { return shell_frame(plate_); }
  void add_to(StateHash& hash) const override;
  void save(StateWriter& writer) const override { writer(*this); }
  void restore(StateReader& reader) override { reader(*this); }
  double mass() const override;
  template <class Archive>
  void archive(Archive& a) {
    a(plate_, strain_mark_, mark_time_, max_strain_rate_);
  }
  long elements() const override { return plate_.mesh().element_count(); }
  const StageTimers& timers() const override { return timers_; }
  RelaxationProblem* relaxation() override { return &relaxation_; }

  const ShellPlate& plate() const { return plate_; }
  ShellPlate& plate() { return plate_; }

 private:
  void watch_strain_rate();

  ShellPlate plate_;
  SurfaceMesh surface_;
  ShellProbes probes_;
  ShellRelaxation relaxation_;
  StageTimers timers_;
  int external_force_, internal_force_, integrate_;
  std::vector<double> strain_mark_;  // plastic strain at the last mark, per point; empty without rate effects
  double mark_time_ = 0.0, max_strain_rate_ = 0.0;
};

}  // namespace standoff::structure
