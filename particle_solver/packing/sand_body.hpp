#pragma once
// A body of sand: the unit cell scaled to edge L, repeated in x, y, z and cut to a shell, sphere, cylinder or box
// [Borvik 2011, sec. 3.3].
//
//   L^3 = (cell count) V / N,  V the body's volume, N the number of grains of the full body    mass = bulk density V
//   / N each
//
// The cells start at a random offset. A cut through a random packing would leave a few grains more or less than N; the
// grains kept are the N nearest to (or deepest in) the body, which moves the cut by a small part of a grain. So count
// and mass are exact, and L, k, radius and mass of a grain are those of the cell. Centres lie in the body; half a
// grain stands out at either surface, so that the mass density is right up to the surface on average.
//
// In a scene that repeats a box as wide as the scene is cut by the faces alone, without sides: the grains kept are the
// N deepest below its top and bottom, and overlaps with images are relaxed like others.
//
// In a quarter model the planes x = 0 and y = 0 are mirrors: no centre may be nearer than its radius. Overlaps (with
// images, or what a cell at random close packing keeps) are relaxed with free surfaces, centres at most a third of a
// radius outside.
#include <cstdint>

#include "coupling/case/case_spec.hpp"
#include "particle_solver/kernels/grain_contact.hpp"
#include "particle_solver/kernels/periodic_images.hpp"
#include "particle_solver/packing/packed_cell.hpp"
#include "particle_solver/state/media.hpp"

namespace standoff::particles {

struct BodyOptions {
  Vec3 centre;           // m
  bool quarter = false;  // keep x >= 0, y >= 0; the centre must lie on both planes
  std::uint64_t seed = 1;
  int cell_count = 1000;  // grains of the unit cell [Borvik 2011, sec. 3.3]
  double overlap = 1e-4;  // largest overlap left, in mean diameters
  int most_iterations = 3000;
  int threads = 1;
  PeriodicSides sides{};  // of a scene that repeats
};

struct SandBody {
  SandState grains;           // at rest, near grains near in memory, ids 0, 1, 2, ...
  GrainLaw law;               // for this size of cell
  double cell_size = 0.0;     // L, m
  double cell_overlap = 0.0;  // largest in the unit cell, in mean diameters
  double cell_coordination = 0.0;
  double residual_overlap = 0.0;  // largest in the body, in mean diameters
  double coordination = 0.0;
  double swelling = 0.0;  // m by which the farthest centre lies outside of the body
  int iterations = 0;
};

SandBody fill_body(const SoilSpec& soil, const BodyOptions& options);

}  // namespace standoff::particles
