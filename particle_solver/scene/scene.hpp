#pragma once
// A validated case as particles and a surface, ready for the time loop: what this scene holds, and nothing else.
#include <memory>
#include <optional>
#include <string>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/state/air.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"
#include "particle_solver/step/sand_pairs.hpp"

namespace standoff::particles {

struct Scene {
  explicit Scene(SurfaceSheet surface) : sheet(std::move(surface)) {}

  bool has_gas = false, has_sand = false, has_air = false;
  GasState gas;              // empty without a charge
  SandState sand;            // empty without soil
  std::unique_ptr<Air> air;  // null in vacuum
  std::optional<SandPairsOptions> sand_law;
  SurfaceSheet sheet;
  Vec3 centre;                                    // m, of the charge
  double sand_cell_size = 0.0;                    // m, edge of the packed cell
  double sand_residual_overlap = 0.0;             // largest initial overlap over radius
  long charge_particles = 0, sand_particles = 0;  // simulated, at the start
};

/// Fills charge and soil around (0, 0, stand_off) above the surface; deterministic in run.seed.
Scene build_scene(const CaseSpec& spec, const SurfaceMesh& mesh, int threads);

/// Largest window [s] over which the wall moves little against a particle: a tenth of the smallest radius at the speed
/// the plate would reach if it took all momentum sent towards it at once (an upper bound, known before the run).
double window_limit(const CaseSpec& spec, const Scene& scene);

}  // namespace standoff::particles
