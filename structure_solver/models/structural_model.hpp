#pragma once
// What every structural model offers: a surface to load, explicit steps, its books. One call per step, never per point.
// Models are chosen by name (plate.model); each lives in its own folder and passes tests/contract/structure_model_*.
//
// The model owns the adjoint pair between the surface it shows and its own degrees of freedom: x_s = N x, f = N^T f_s,
// so the work of the surface force equals the work on the degrees of freedom, and the total force is kept exactly.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "coupling/base/stage_timer.hpp"
#include "coupling/base/state_archive.hpp"
#include "coupling/base/state_hash.hpp"
#include "coupling/case/case_spec.hpp"
#include "coupling/contract/surface.hpp"

namespace standoff::structure {

class RelaxationProblem;

/// Books of the simulated part, SI. Energies in J, impulses in N s.
struct StructureLedger {
  double kinetic = 0.0, elastic = 0.0;  // now
  double plastic = 0.0;                 // plastic work since the start (heat is chi times it)
  double damping = 0.0;                 // taken out by damping since the start
  double external_work = 0.0;           // work of the surface force since the start
  Vec3 momentum;                        // now
  Vec3 impulse_received;                // surface force over time since the start
  Vec3 impulse_of_supports;             // clamps and symmetry planes on the plate since the start
  /// external_work - kinetic - elastic - plastic - damping: zero up to the error of the time integration.
  double balance() const { return external_work - kinetic - elastic - plastic - damping; }
};

/// Extremes over the whole history, for the result table.
struct StructureExtremes {
  double max_plastic_strain = 0.0, centre_plastic_strain = 0.0, max_plastic_strain_away_from_clamp = 0.0;
  double max_strain_rate = 0.0;       // 1/s: largest plastic strain gained over 10 us, divided by it
  double max_temperature_rise = 0.0;  // K
};

/// One frame for ParaView: the simulated part as arbitrary-order cells.
struct StructureFrame {
  std::vector<Vec3> position;                    // node positions now
  std::vector<Vec3> displacement, velocity;      // per node
  std::vector<std::vector<std::int64_t>> cells;  // per cell, nodes in VTK order of `vtk_cell_type`
  int vtk_cell_type = 72;                        // 72 Lagrange hexahedron, 12 hexahedron, 9 quad
  std::vector<std::pair<std::string, std::vector<double>>>
      cell_data;  // e.g. plastic_strain, temperature_K, von_mises_Pa
};

struct ProfilePoint {
  double x = 0.0, deflection = 0.0;  // m, along the centre line y = 0 of the full plate; positive away from the charge
};

/// What a station of observe.probes sees of the wall.
struct WallProbe {
  double place = 0.0;         // m, along the axis
  double displacement = 0.0;  // m, away from the charge
  double velocity = 0.0;      // m/s
};

class StructuralModel {
 public:
  virtual ~StructuralModel() = default;

  virtual const SurfaceMesh& surface() const = 0;
  /// Positions and velocities of the surface nodes at the current time level, both at t_n.
  virtual void surface_motion(SurfaceMotion& motion) const = 0;
  /// Force on the surface nodes [N], held until replaced.
  virtual void set_surface_force(std::span<const Vec3> force) = 0;

  /// Largest stable step of the present, deformed shape [s], with the model's safety factor applied.
  virtual double stable_step() const = 0;
  /// One explicit step; throws Stop(guard) naming element and time if the model breaks.
  virtual void step(double dt) = 0;
  virtual double time() const = 0;

  virtual StructureLedger ledger() const = 0;
  virtual StructureExtremes extremes() const = 0;
  /// Displacement of the plate centre, positive away from the charge [m].
  virtual double centre_deflection() const = 0;
  virtual double max_deflection() const = 0;
  virtual std::vector<ProfilePoint> profile() const = 0;
  virtual StructureFrame frame() const = 0;
  /// The stations of observe.probes, for models that have a wall to observe.
  virtual std::vector<WallProbe> probes() const { return {}; }
  virtual void add_to(StateHash& hash) const = 0;
  /// All that outlives a step, and back into a model built from the same case: what follows has the same bits.
  virtual void save(StateWriter& writer) const = 0;
  virtual void restore(StateReader& reader) = 0;
  /// Mass that moves under the load, clamped nodes included [kg].
  virtual double mass() const = 0;
  virtual long elements() const = 0;  // simulated
  /// Stages external_force, internal_force, integrate with their seconds.
  virtual const StageTimers& timers() const = 0;

  /// What relaxation works on, or null for a model that cannot be relaxed (a rigid plate is at rest as it is).
  virtual RelaxationProblem* relaxation() { return nullptr; }
};

/// Every model by name.
std::vector<std::string> structural_model_names();
/// Builds the model named by plate.model; throws Stop(bad_case) for an unknown name, listing the known ones.
std::unique_ptr<StructuralModel> make_structural_model(const CaseSpec& spec, int threads);

}  // namespace standoff::structure
