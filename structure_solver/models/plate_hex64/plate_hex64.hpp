#pragma once
// Model "plate_hex64": a plate of cubic 64-node hexahedra, Johnson-Cook metal, explicit central differences.
#include "structure_solver/models/plate_hex64/plate_relaxation.hpp"
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {

class PlateHex64 : public StructuralModel {
 public:
  PlateHex64(const CaseSpec& spec, int threads);
  /// The same solid on another mesh of the kind, such as a pipe.
  PlateHex64(PlateMesh mesh, const CaseSpec& spec, int threads);

  const SurfaceMesh& surface() const override { return map_.surface(); }
  void surface_motion(SurfaceMotion& motion) const override;
  void set_surface_force(std::span<const Vec3> force) override;
  double stable_step() const override { return plate_.stable_step(); }
  void step(double dt) override;
  double time() const override { return plate_.time(); }
  StructureLedger ledger() const override;
  StructureExtremes extremes() const override;
  double centre_deflection() const override { return probes_.centre_deflection(plate_.state().u); }
  double max_deflection() const override { return probes_.max_deflection(plate_.state().u); }
  std::vector<ProfilePoint> profile() const override { return probes_.profile(plate_.state().u); }
  StructureFrame frame() const override { return plate_frame(plate_); }
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

  const PlateSolid& plate() const { return plate_; }

 private:
  void watch_strain_rate();
  double answer_time(const CaseSpec& spec) const;

  PlateSolid plate_;
  SurfaceMap map_;
  PlateProbes probes_;
  PlateRelaxation relaxation_;
  StageTimers timers_;
  int external_force_, internal_force_, integrate_;
  std::vector<double> strain_mark_;  // plastic strain at the last mark, per Gauss point; empty without rate effects
  double mark_time_ = 0.0, max_strain_rate_ = 0.0;
};

}  // namespace standoff::structure
