#pragma once
// Two cubes of packed sand that fly into each other with 300 m/s each, the second one shifted across.
#include <cmath>
#include <vector>

#include "particle_solver/packing/packed_cell.hpp"
#include "particle_solver/step/sand_integrate.hpp"

namespace standoff::particles::test {

inline SandState two_clouds(bool radii, double mass = 1e-5, double cell_size = 0.02) {
  const PackedCell& cell = pack_cell({1000, 0.58, radii ? 0.025 : 0.0, 3});
  std::vector<Vec3> places;
  for (const Vec3& p : cell.position) places.push_back(cell_size * p);
  for (const Vec3& p : cell.position) places.push_back(cell_size * (p + Vec3{1.11, 0.3, 0.2}));
  SandState sand = make_grains(places, cell_size * cell.mean_radius, mass);
  for (std::size_t i = 0; i < sand.size(); ++i) {
    sand.velocity[i] = {i < 1000 ? 300.0 : -300.0, 0, 0};
    if (!radii) continue;
    sand.grain_radius.push_back(cell_size * cell.radius[i % 1000]);
    sand.grain_mass.push_back(mass * std::pow(cell.radius[i % 1000] / cell.mean_radius, 3.0));
  }
  return sand;
}

}  // namespace standoff::particles::test
