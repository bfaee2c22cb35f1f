#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/case/effects/effect.hpp"
#include "coupling/case/soil_body.hpp"

namespace standoff::effects {

double soil_mass(const SoilSpec& soil) {
  return soil.kind == SoilKind::none ? 0.0 : soil.bulk_density * SoilBody(soil, {}).volume();
}

Estimate estimate(const CaseSpec& spec) {
  Estimate e;
  const ChargeSpec& c = spec.charge;
  const MaterialSpec& m = spec.plate.material;
  if (!c.present || spec.run.stand_off <= 0.0) return e;
  e.mass = c.mass + soil_mass(spec.soil);
  e.speed = std::sqrt(2.0 * c.mass / c.explosive.density * c.explosive.energy / e.mass);
  e.arriving = e.mass / (4.0 * std::numbers::pi * spec.run.stand_off * spec.run.stand_off);
  e.plate = m.density * spec.plate.size.z;
  e.wall_speed = e.speed * e.arriving / (e.arriving + e.plate);
  e.rate = e.wall_speed / (0.5 * std::min(spec.plate.size.x, spec.plate.size.y));
  e.heating = m.specific_heat > 0.0 ? m.taylor_quinney * e.wall_speed * e.wall_speed / (2.0 * m.specific_heat) : 0.0;
  return e;
}

}  // namespace standoff::effects
