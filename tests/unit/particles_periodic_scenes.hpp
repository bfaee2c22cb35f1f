#pragma once
// Spheres of a sixteenth of a period of 1 m in a scene that repeats.
#include "particle_solver/step/sand_integrate.hpp"
#include "particle_solver/step/wrap.hpp"
#include "tests/unit/particles_air_scenes.hpp"
#include "tests/unit/particles_gas_scenes.hpp"

namespace standoff::particles::test {

inline const PeriodicSides sides = periodic_sides(true, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
inline constexpr double radius = 1.0 / 16, sub_step = 1.0 / 32;  // m, s

struct Outcome {
  std::vector<Vec3> velocity, position;
  long hits = 0;
};

inline Vec3 home(const Vec3& x) {
  return image_inside(sides, x);
}

inline GasState spheres(const std::vector<Vec3>& at, const std::vector<Vec3>& velocity) {
  GasState gas;
  gas.mass = 1.0, gas.radius = radius, gas.gamma = 1.4;
  for (std::uint32_t i = 0; i < at.size(); ++i) gas.position.push_back(home(at[i])), gas.id.push_back(i);
  gas.velocity = velocity, gas.internal_energy.assign(at.size(), 0.5);
  return gas;
}
inline SandState grains(const std::vector<Vec3>& at, const std::vector<Vec3>& velocity) {
  std::vector<Vec3> inside;
  for (const Vec3& x : at) inside.push_back(home(x));
  SandState sand = make_grains(std::move(inside), radius, 3.0);
  sand.velocity = velocity;
  return sand;
}

inline Outcome after_sub_step(GasState gas, SandState* sand, SurfaceSheet* sheet) {
  GasCollideOptions options;
  options.periodic = sides;
  const GasCollideCounts counts =
      GasCollide(options).run(gas, sand, sheet, sub_step, 1);  // of no call that sorts the arrays
  gas_drift(gas, sand, sheet, sub_step);
  Outcome outcome{gas.velocity, gas.position, counts.hits()};
  if (sand == nullptr) return outcome;
  outcome.velocity.insert(outcome.velocity.end(), sand->velocity.begin(), sand->velocity.end());
  outcome.position.insert(outcome.position.end(), sand->position.begin(), sand->position.end());
  return outcome;
}

}  // namespace standoff::particles::test
