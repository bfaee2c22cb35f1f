#pragma once
// A box of ambient air, alone or over a plate at rest.
#include <memory>

#include "particle_solver/kernels/larsen_borgnakke.hpp"
#include "particle_solver/state/air.hpp"
#include "particle_solver/state/surface_sheet.hpp"
#include "particle_solver/step/air_boundaries.hpp"
#include "particle_solver/step/air_collide.hpp"
#include "particle_solver/step/air_drift.hpp"

namespace standoff::particles {

struct AirBox {
  Vec3 lower, upper;
  double cell = 0.0, particles_a_cell = 8.0;
  double cover = 0.0;  // m, half width of plate and cover; 0: none
};

inline std::unique_ptr<Air> air_in(const AirBox& box) {
  AmbientGas ambient{101300.0, 1.3, 1.3 * box.cell * box.cell * box.cell / box.particles_a_cell, 2.0};
  AirCellsOptions cells{box.lower, box.upper, box.cell, box.cover, box.cover, false, false};
  auto air = std::make_unique<Air>(Air{ambient, 0.5 * box.cell, 0.0, 3.4, AirCells(cells), {}, 0, {}, 0.0, {}, 0.0});
  air->cross_section = cross_section(ambient, air->mean_free_path);
  air->particles.mass = ambient.particle_mass, air->particles.gamma = 1.4;
  air->particles.radius = 0.05 * box.cell;
  return air;
}

/// Steps of air alone, or of air over a sheet.
class AirLoop {
 public:
  AirLoop(Air& air, SurfaceSheet* sheet, Boundaries exits, int threads = 1)
      : air_(air), sheet_(sheet), exits_(std::move(exits)), collide_(1, threads), drift_({}, threads) {}
  void wake_everything() {
    air_.cells.wake_all();
    edge_.run(air_, nullptr, nullptr, sheet_, exits_, books, 0.0, 0);
  }
  void step(double dt) {
    ++number_;
    collide_.run(air_, nullptr, dt, number_);
    front += drift_.run(air_, nullptr, sheet_, dt).plate_impulse;
    rear += edge_.run(air_, nullptr, nullptr, sheet_, exits_, books, dt, number_);
    if (sheet_ != nullptr) sheet_->drift(dt);
  }
  BoundaryBooks books;
  double front = 0.0, rear = 0.0;  // N s on the plate, positive away from the air
  long collisions() const { return collide_.collisions(); }

 private:
  Air& air_;
  SurfaceSheet* sheet_;
  Boundaries exits_;
  AirCollide collide_;
  AirDrift drift_;
  AirBoundaries edge_{AirBoundariesOptions{}};
  std::uint32_t number_ = 0;
};

}  // namespace standoff::particles
