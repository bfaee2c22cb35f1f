#pragma once
// Small gases for the tests.
#include <cmath>
#include <limits>

#include "coupling/base/counter_random.hpp"
#include "particle_solver/state/media.hpp"
#include "particle_solver/step/detonate.hpp"
#include "particle_solver/step/gas_collide.hpp"
#include "particle_solver/step/gas_drift.hpp"

namespace standoff::particles::test {

/// 4 n^3 particles on a face-centred lattice in a unit cube, mass 1 kg in all, velocity components of unit variance,
/// and `internal` times the kinetic energy in the reservoirs.
inline GasState lattice_gas(int n, double fill, double gamma, double internal, std::uint64_t seed = 1) {
  GasState gas;
  const int count = 4 * n * n * n;
  const double corner[4][3] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  gas.mass = 1.0 / count, gas.gamma = gamma;
  gas.radius = std::cbrt(3.0 * fill / (4.0 * 3.141592653589793 * count));
  for (int cell = 0; cell < n * n * n; ++cell)
    for (const auto& c : corner) {
      const auto id = static_cast<std::uint32_t>(gas.id.size());
      CounterRandom random(seed, RandomUse::test, id);
      gas.position.push_back(Vec3{cell % n + 0.25 + c[0], cell / n % n + 0.25 + c[1], cell / n / n + 0.25 + c[2]} /
                             static_cast<double>(n));
      const double x = random.normal(), y = random.normal(), z = random.normal();
      gas.velocity.push_back({x, y, z});
      gas.id.push_back(id);
    }
  gas.internal_energy.assign(gas.size(), internal * 1.5 * gas.mass);
  gas.plate_rebound.assign(gas.size(), std::numeric_limits<double>::quiet_NaN());
  return gas;
}

/// Runs `steps` sub-steps of the size the gas asks for, calling each(counts, step size) after every one.
template <class Each>
void run_gas(GasCollide& collide, GasState& gas, SandState* sand, SurfaceSheet* sheet, int steps, double cap,
             Each&& each) {
  GasCollideCounts counts;
  double h = 0.0, time = 0.0;
  for (int step = 0; step < steps; ++step) {
    detonate(gas, time);
    h = collide.suggest_step(gas, counts, h, cap);
    counts = collide.run(gas, sand, sheet, h, static_cast<std::uint32_t>(step));
    gas_drift(gas, sand, sheet, h);
    time += h;
    each(counts, h);
  }
}

/// Sum of m |v|: what a momentum error is measured against.
inline double momentum_scale(const GasState& gas) {
  double sum = 0.0;
  for (const Vec3& v : gas.velocity) sum += gas.mass * norm(v);
  return sum;
}

}  // namespace standoff::particles::test
