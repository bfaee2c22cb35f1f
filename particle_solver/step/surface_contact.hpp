#pragma once
// Stage surface_contact: grains against the sheet, between the half kick and the drift.
//
// Two laws, chosen once. Impulse: a grain that touches (gap < radius) and approaches gets an impact with the case's
// restitution and friction; unilateral and, with restitution 0, inelastic, so that a loaded layer does not creep into
// the plate: what the other grains pushed it by in the half kick is taken out again before it moves. Spring: the soil's
// own spring and dashpot, pushed as force times step. Friction turns grains that can turn. A grain that will touch
// during the coming drift is met in the next step; with |v| h < 0.1 radius that is 0.1 radius late. Touching grains are
// found in parallel and resolved one after the other in the order of the arrays, each against the wall as the ones
// before it left it: the same bits for any number of threads.
#include <cstdint>
#include <vector>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/kernels/surface_impact.hpp"
#include "particle_solver/kernels/surface_spring.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

/// What one call did. Impulses in N s, positive away from the charge, on the plate without its rigid surround.
struct SurfaceContactCounts {
  long hits = 0;                         // impulses given, plate and surround
  double plate_impulse = 0.0;            // N s
  double plate_incoming = 0.0;           // kg m/s of grains at their first contact with the plate
  double plate_work = 0.0;               // J given to the plate
  double loss = 0.0;                     // J dissipated at plate and surround
  double elastic_energy = 0.0;           // J in the springs now; 0 with the impulse law
  double penetration_over_radius = 0.0;  // largest (radius - gap) / radius met in this call
};

struct SurfaceContactOptions {
  bool spring = false;      // the soil's own law instead of an impact
  SurfaceImpactLaw impact;  // used without spring
  SurfaceSpringLaw soil;    // used with spring
  int threads = 1;
  bool turning = false;  // grains have spins, which friction changes
};

/// The options a case asks for; `stiffness` [N/m] is that of the soil's grains, k = (L/L0) k0.
SurfaceContactOptions surface_contact_options(const CaseSpec& spec, double stiffness, int threads);

class SurfaceContact {
 public:
  explicit SurfaceContact(const SurfaceContactOptions& options);
  /// Contacts of `sand` at its present positions; `h` [s] is the sand step. Does not move the sheet. `sheet_time` [s]
  /// is how far the sand stands into the sheet's present sub-step.
  SurfaceContactCounts run(SandState& sand, SurfaceSheet& sheet, double h, double sheet_time = 0.0);
  /// J in the springs between `sand` and sheet as they lie; 0 with the impulse law. For the first reading of the
  /// ledger: grains that are pressed into the plate at the start bring that energy with them.
  double stored_energy(const SandState& sand, const SurfaceSheet& sheet);

  /// J in the springs of the grains `out` (ascending) as the last call of run() met them: for grains that are taken
  /// out.
  double stored_in(const std::vector<std::uint32_t>& out) const;

 private:
  struct Touch {
    std::uint32_t grain;
    SheetPoint where;
    double stored = 0.0;  // J, half of k overlap^2; 0 with the impulse law
  };
  template <bool EqualRadii>
  void find(const SandState& sand, const SurfaceSheet& sheet, double t);
  template <bool Turning>
  void impact(const Touch& touch, SandState& sand, SurfaceSheet& sheet, double t, SurfaceContactCounts& counts) const;
  template <bool Turning>
  void spring(Touch& touch, SandState& sand, SurfaceSheet& sheet, double h, double t,
              SurfaceContactCounts& counts) const;
  template <bool Spring, bool Turning>
  SurfaceContactCounts resolve(SandState& sand, SurfaceSheet& sheet, double h, double t);

  SurfaceContactOptions options_;
  using Resolve = SurfaceContactCounts (SurfaceContact::*)(SandState&, SurfaceSheet&, double h, double t);
  Resolve resolve_;                        // for the law and the grains of this scene
  std::vector<std::vector<Touch>> found_;  // by thread, together in the order of the grains
};

}  // namespace standoff::particles
