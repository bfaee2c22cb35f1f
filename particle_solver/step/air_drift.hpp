#pragma once
// Stage air_drift: air flies on for a step. Straight where nothing is in the way; against mirrors, grains, plate and
// cover hit by hit at the exact time, as gas does (gas_collide.hpp), but one particle after the other: the order of
// hits of different particles on one grain or face within a step is not kept, which a dilute gas does not feel.
// Momentum and energy are exact. Air flies once a window, which is several steps of grains: a grain takes its impulse
// at once and is not shifted back as media.hpp would have it, because its neighbours would feel the shift as an
// overlap.
#include "particle_solver/kernels/periodic_images.hpp"
#include "particle_solver/kernels/reflecting_planes.hpp"
#include "particle_solver/search/gas_cell_grid.hpp"
#include "particle_solver/search/gas_near_map.hpp"
#include "particle_solver/state/air.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

struct AirDriftCounts {
  double plate_impulse = 0.0;   // N s given to the plate (not its cover), positive away from the charge
  double plate_incoming = 0.0;  // kg m/s at first contact, likewise
  Vec3 mirror_impulse;          // N s given to mirrors and walls of the box
  long sheet_hits = 0, sand_hits = 0;
};

class AirDrift {
 public:
  AirDrift(const ReflectingPlanes& planes, int threads, const PeriodicSides& sides = {})
      : planes_(planes), sides_(sides), threads_(threads) {}
  /// Positions of the air are moved to the end of the step; grains and sheet keep the convention of media.hpp.
  AirDriftCounts run(Air& air, SandState* sand, SurfaceSheet* sheet, double dt);

 private:
  struct Hit;
  template <bool Periodic>
  AirDriftCounts run_images(Air& air, SandState* sand, SurfaceSheet* sheet, double dt);
  template <bool Periodic>
  void list_those_near(const Air& air, const SandState* sand, const SurfaceSheet* sheet, double dt);
  void sort_grains(const SandState& sand, double radius, double dt);
  template <bool Periodic>
  Hit earliest(const GasState& gas, std::size_t i, double from, double dt, const SandState* sand,
               const SurfaceSheet* sheet) const;
  template <bool Periodic>
  void fly(Air& air, std::size_t i, SandState* sand, SurfaceSheet* sheet, double dt, AirDriftCounts& counts);

  ReflectingPlanes planes_;
  PeriodicSides sides_;
  int threads_;
  std::vector<std::uint8_t> near_;  // of every particle
  GasCellGrid grains_;
  GasNearMap near_grains_;
  std::vector<Vec3> middle_;
  double grain_reach_ = 0.0;  // m, largest contact distance plus half the longest path of a grain
};

}  // namespace standoff::particles
