#pragma once
// Stage wrap: the end of a drift in a scene that repeats. What has left through a face across x or y comes in at the
// opposite one; nothing else about it changes, so no book knows of it. Air does it itself (air_drift).
//
// Between two calls a centre may lie outside: every search looks at nearest images (kernels/periodic_images.hpp), and a
// path that leads out is followed on the other side where it may meet the sheet.
#include "particle_solver/kernels/periodic_images.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/state/surface_sheet.hpp"

namespace standoff::particles {

/// `gas` and `sand` may be null.
void wrap(const PeriodicSides& sides, GasState* gas, SandState* sand);

/// SurfaceSheet::first_hit for a path that may pass faces.
bool first_hit_on_the_way(const PeriodicSides& sides, const SurfaceSheet& sheet, const Vec3& x, const Vec3& v,
                          double radius, double from, double until, double& time, SheetPoint& where);

}  // namespace standoff::particles
