#include "particle_solver/step/wrap.hpp"

namespace standoff::particles {

void wrap(const PeriodicSides& sides, GasState* gas, SandState* sand) {
  const auto bring_home = [&](std::vector<Vec3>& positions) {
    for (Vec3& x : positions) x = image_inside(sides, x);
  };
  if (gas != nullptr) bring_home(gas->position);
  if (sand != nullptr) bring_home(sand->position);
}

bool first_hit_on_the_way(const PeriodicSides& sides, const SurfaceSheet& sheet, const Vec3& x, const Vec3& v,
                          double radius, double from, double until, double& time, SheetPoint& where) {
  const Vec3 here = x + v * from;
  for (Vec3 start = x + (image_inside(sides, here) - here);;) {
    const PlaneHit face = first_plane(sides.faces, start, v, from, until);
    if (sheet.first_hit(start, v, radius, from, std::min(face.time, until), time, where)) return true;
    if (face.time == no_impact) return false;
    start += shift_at_face(sides, v, face.axis);
    from = face.time;
  }
}

}  // namespace standoff::particles
