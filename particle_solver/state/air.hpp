#pragma once
// Ambient air around charge and plate: particles where it is awake, and what still air is everywhere else.
//
// Air particles are points for each other and for the products (collision_pairs.hpp) and small spheres for grains,
// surface and cover. `disturbed` marks a particle that something other than still air has touched, directly or through
// others: it is how a cell knows that the air in it no longer stands still, exactly and without a threshold.
#include <optional>

#include "coupling/case/soil_body.hpp"
#include "particle_solver/kernels/ambient_gas.hpp"
#include "particle_solver/search/air_cells.hpp"
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

struct Air {
  AmbientGas ambient;
  double mean_free_path = 0.0;  // m, at rest
  double cross_section = 0.0;   // m2
  double still_speed = 0.0;     // m/s; a wall or grain slower than this leaves air undisturbed
  AirCells cells;
  GasState particles;  // those awake
  std::uint32_t next_id = 0;
  Vec3 body_centre;              // m; no air inside the charge
  double body_radius = 0.0;      // m
  std::optional<SoilBody> sand;  // no air inside its outer surface either
  double woken = 0.0;            // particles filled in so far
  template <class Archive>
  void archive(Archive& a) {
    a(cells, particles, next_id, woken);
  }
};

}  // namespace standoff::particles
