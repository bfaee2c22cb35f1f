#pragma once
// Moves grains apart until they no longer overlap: the energy sum of k overlap^2/2 is minimised, inertia and all, by
// FIRE.
//
//   v <- (1 - a) v + a |v| F/|F|;  while F.v > 0 for 5 steps: dt <- min(1.1 dt, dt_max), a <- 0.99 a;
//   else v <- 0, dt <- dt/2, a <- 0.1
// Source: Bitzek, Koskinen, Gaehler, Moseler, Gumbsch, Phys. Rev. Lett. 97, 170201 (2006), with its constants. Unit
// masses and k = 1, so dt_max = 0.35 lies well below the limit 2/omega (z = 12 contacts: 2/sqrt(24) = 0.41).
//
// Why: sand lies at rest before the charge goes off, so nothing in it may be pressed. What cannot be relaxed away stays
// as springs, whose energy is part of the first reading of the ledger: it closes, and grains gain no more than that.
//
// Below random close packing it ends without overlap. Above, in a periodic cell, overlaps remain and balance: that is
// noticed by the unbalanced force, and what is left is reported.
#include <optional>

#include "coupling/case/soil_body.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/step/sand_pairs.hpp"

namespace standoff::particles {

/// Centres stay at most `play` [m] outside of a body.
struct BodyBounds {
  SoilBody body;
  double play = 0.0;
};

struct RelaxOptions {
  double overlap = 1e-6;  // largest overlap that may stay, in mean diameters
  double balance = 1e-3;  // or: largest unbalanced force over mean contact force, where overlaps cannot vanish
  int most_iterations = 6000;
  std::optional<BodyBounds> bounds;
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
