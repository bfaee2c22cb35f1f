#pragma once
// Moves grains apart until they no longer overlap: the energy sum of k overlap^2/2 is minimised, inertia and all, by
// FIRE.
//
//   v <- (1 - a) v + a |v| F/|F|;  while F.v > 0 for 5 steps: dt <- min(1.1 dt, dt_max), a <- 0.99 a;
//   else v <- 0, dt <- dt/2, a <- 0.1
// Source: Bitzek, Koskinen, Gaehler, Moseler, Gumbsch, Phys. Rev. Lett. 97, 170201 (2006), with its constants. Unit
// masses and k = 1, so dt_max = 0.35 lies well below the limit 2/omega (z = 12 contacts: 2/sqrt(24) = 0.41).
//
// Below random close packing it ends without overlap. Above, in a periodic cell, overlaps remain and balance: that is
// noticed by the unbalanced force, and what is left is reported.
#include <optional>

#include "particle_solver/state/media.hpp"
#include "particle_solver/step/sand_pairs.hpp"

namespace standoff::particles {

/// Centres stay between two spheres.
struct ShellBounds {
  Vec3 centre;
  double inner = 0.0, outer = 0.0;  // m
};

struct RelaxOptions {
  double overlap = 1e-6;  // largest overlap that may stay, in mean diameters
  double balance = 1e-3;  // or: largest unbalanced force over mean contact force, where overlaps cannot vanish
  int most_iterations = 6000;
  std::optional<ShellBounds> bounds;
};

struct RelaxResult {
  double overlap = 0.0;  // largest left, in mean diameters
  double balance = 0.0;  // largest unbalanced force over mean contact force
  int iterations = 0;
  bool free = false;  // overlaps are gone
};

/// Uses velocity and force of `grains` as scratch; leaves them zero. `pairs`: stiffness 1, no friction, no damping.
RelaxResult relax_overlaps(SandState& grains, SandPairs& pairs, const RelaxOptions& options);

}  // namespace standoff::particles
