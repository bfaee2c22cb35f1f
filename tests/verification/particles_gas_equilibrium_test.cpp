// Law: with gamma = 1.4 a share xi = 3 (gamma - 1) / 2 = 0.6 of the energy is translational in equilibrium, velocities
// are Maxwellian (<v_x^4> = 3 <v_x^2>^2) and internal energies with zeta = 2 exponential (<e^2> = 2 <e>^2), whatever
// the start. Tolerance: fluctuation of one snapshot of N = 2048 particles at fixed total energy, averaged over 20
// snapshots about 3 collisions a particle apart (independent); five standard errors:
//   share: sum of N exchanges, sd = sqrt(xi (1-xi) / (5N/2)) = 0.0069; fourth moment ratio: sd = sqrt(24 / 3N) = 0.063;
//   <e^2>/<e>^2: sd = 2 / sqrt(N) = 0.044.
#include <gtest/gtest.h>

#include "tests/unit/particles_gas_scenes.hpp"

namespace standoff::particles {
namespace {

struct Moments {
  double share = 0.0, fourth = 0.0, square = 0.0;
};

Moments moments(const GasState& gas) {
  double v2 = 0.0, v4 = 0.0, e1 = 0.0, e2 = 0.0;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    for (const double v : {gas.velocity[i].x, gas.velocity[i].y, gas.velocity[i].z}) v2 += v * v, v4 += v * v * v * v;
    e1 += gas.internal_energy[i], e2 += gas.internal_energy[i] * gas.internal_energy[i];
  }
  const double n = static_cast<double>(gas.size());
  const GasTotals totals = gas_totals(gas);
  return {totals.kinetic / totals.energy(), (v4 / (3 * n)) / (v2 / (3 * n)) / (v2 / (3 * n)),
          e2 / n / (e1 / n) / (e1 / n)};
}

TEST(GasBox_AllTranslationalStart_RelaxesToEquilibrium, ShareAndMoments) {
  GasState gas = test::lattice_gas(8, 0.20, 1.4, 0.0);
  for (Vec3& v : gas.velocity) v *= 1.0 / norm(v);  // one speed only: far from a Maxwellian
  GasCollideOptions options;
  options.periodic.period = period_of({1.0, 1.0, 1.0});
  GasCollide collide(options);
  Moments mean;
  constexpr int snapshots = 20;
  double collisions = 0.0;  // a particle, since the last snapshot
  int taken = -5;           // 15 collisions a particle to forget the start
  const double n = static_cast<double>(gas.size());
  for (std::uint32_t step = 0; taken < snapshots; ++step) {
    const double h = 0.1 * 2.0 * gas.radius;
    collisions += 2.0 * static_cast<double>(collide.run(gas, nullptr, nullptr, h, step).gas_hits) / n;
    gas_drift(gas, nullptr, nullptr, h);
    if (collisions < 3.0) continue;
    collisions = 0.0;
    if (taken++ < 0) continue;
    const Moments now = moments(gas);
    mean.share += now.share / snapshots, mean.fourth += now.fourth / snapshots, mean.square += now.square / snapshots;
  }
  const double error = 5.0 / std::sqrt(snapshots);
  EXPECT_NEAR(mean.share, 0.6, error * 0.0069);
  EXPECT_NEAR(mean.fourth, 3.0, error * 0.063);
  EXPECT_NEAR(mean.square, 2.0, error * 0.044);
}

TEST(GasBox_WithoutExchange_KeepsItsReservoirs, KineticEnergyIsConstant) {
  GasState gas = test::lattice_gas(5, 0.20, 1.4, 0.5);
  const std::vector<double> before = gas.internal_energy;
  GasCollideOptions options;
  options.periodic.period = period_of({1.0, 1.0, 1.0}), options.internal_energy = false;
  GasCollide collide(options);
  const double kinetic = gas_totals(gas).kinetic;
  long hits = 0;
  test::run_gas(collide, gas, nullptr, nullptr, 50, 1e9, [&](const auto& counts, double) { hits += counts.gas_hits; });
  EXPECT_GT(hits, 500);
  EXPECT_EQ(gas.internal_energy, before);
  EXPECT_NEAR(gas_totals(gas).kinetic, kinetic, 1e-12 * kinetic);
}

}  // namespace
}  // namespace standoff::particles
