#pragma once
// Stage air_boundaries: where simulated air ends and still air begins.
//
//   1  take out what flew into still air, out of the box or behind the cover
//   2  wake the neighbours of cells in which something happens: disturbed air, products, moving grains; fill them
//   3  still air sends its half-Maxwellian through every face to an awake cell
//   4  the ambient pressure on the rear of the plate, under awake air; elsewhere front and rear cancel exactly
//
// A box that is open to ambient air is the same thing as a sleeping neighbour. Everything that comes in or goes out is
// booked, so the ledger closes. Effect ambient_pressure off leaves out 4 (a plate with vacuum behind it).
#include "particle_solver/kernels/periodic_images.hpp"
#include "particle_solver/state/air.hpp"
#include "particle_solver/state/surface_sheet.hpp"
#include "particle_solver/step/boundaries.hpp"

namespace standoff::particles {

struct AirBoundariesOptions {
  std::uint64_t seed = 1;
  bool rear_pressure = true;
  PeriodicSides sides{};  // of a scene that repeats
};

class AirBoundaries {
 public:
  explicit AirBoundaries(const AirBoundariesOptions& options) : options_(options) {}
  /// End of a step `number` of length dt. `products`, `sand`, `sheet` may be null. Returns the impulse of the rear
  /// pressure on the plate, N s, positive away from the charge (so it is negative).
  double run(Air& air, const GasState* products, const SandState* sand, SurfaceSheet* sheet, Boundaries& exits,
             BoundaryBooks& books, double dt, std::uint32_t number);

 private:
  void take_out_sleepers(Air& air, Boundaries& exits, BoundaryBooks& books);
  void wake(Air& air, const GasState* products, const SandState* sand, BoundaryBooks& books);
  void let_in(Air& air, BoundaryBooks& books, double dt, std::uint32_t number);
  double press_rear(const Air& air, SurfaceSheet& sheet, BoundaryBooks& books, double dt) const;
  void add(Air& air, const Vec3& position, const Vec3& velocity, double internal, BoundaryBooks& books);

  AirBoundariesOptions options_;
  std::vector<std::uint32_t> out_;
};

}  // namespace standoff::particles
