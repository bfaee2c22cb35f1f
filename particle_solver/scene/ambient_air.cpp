#include "particle_solver/scene/ambient_air.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particle_solver/kernels/larsen_borgnakke.hpp"

namespace standoff::particles {
namespace {

// Mean free path over the cell: as long as the cells can resolve, so that the front is as thin as they allow.
constexpr double free_path_over_cell = 0.5;
// Volume of the spheres by which air meets walls and grains, over the volume of the air: Z - 1 < 0.5 % if they met each
// other so, which they do not.
constexpr double wall_fill = 0.001;
// Walls and grains slower than this part of the speed of sound leave air as it is: pressure moves by gamma times it.
constexpr double still_mach = 0.01;

AirCellsOptions cell_options(const CaseSpec& spec, double size) {
  AirCellsOptions options;
  options.lower = spec.domain.lower, options.upper = spec.domain.upper;
  options.size = size;
  options.mirrors = spec.run.quarter_symmetry;
  options.closed = spec.domain.closed(), options.repeats = spec.domain.repeats();
  if (options.mirrors) options.lower.x = options.lower.y = 0.0;
  const bool cover = spec.plate.surround == "rigid";
  options.cover_x = 0.5 * (cover ? spec.plate.surround_size : spec.plate.size.x);
  options.cover_y = 0.5 * (cover ? spec.plate.surround_size : spec.plate.size.y);
  return options;
}

}  // namespace

std::unique_ptr<Air> build_air(const CaseSpec& spec) {
  AmbientGas ambient;
  ambient.pressure = spec.air.pressure, ambient.density = spec.air.density;
  ambient.particle_mass = spec.air.density * nominal_air_volume / static_cast<double>(spec.air.particles);
  ambient.zeta = internal_degrees_of_freedom(spec.air.gamma);
  const double size = std::cbrt(particles_an_air_cell / ambient.number_density());
  auto air = std::make_unique<Air>(Air{ambient,
                                       free_path_over_cell * size,
                                       0.0,
                                       0.0,
                                       AirCells(cell_options(spec, size)),
                                       {},
                                       0,
                                       {0.0, 0.0, spec.run.stand_off},
                                       0.0,
                                       {},
                                       0.0});
  air->cross_section = cross_section(ambient, air->mean_free_path);
  air->still_speed = still_mach * std::sqrt(spec.air.gamma * spec.air.pressure / spec.air.density);
  if (spec.charge.present) air->body_radius = spec.charge.radius;
  if (spec.soil.kind != SoilKind::none)
    air->sand.emplace(without_cut_sides(spec.soil, spec.domain.period()), air->body_centre);
  GasState& gas = air->particles;
  gas.mass = ambient.particle_mass, gas.gamma = spec.air.gamma;
  gas.radius = std::cbrt(3.0 * wall_fill / (4.0 * std::numbers::pi * ambient.number_density()));
  return air;
}

}  // namespace standoff::particles
