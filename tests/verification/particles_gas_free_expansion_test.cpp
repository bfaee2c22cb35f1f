// Law: a layer of gas at rest before a wall is let go into vacuum. Until the rarefaction reaches the wall the flow is a
// centred fan, du = -c d ln rho, d ln T = (gamma - 1) Z d ln rho, x / t = u - c, which turns heat into motion as gamma
// says [Landau & Lifshitz, Fluid Mechanics, sec. 99; Z of hard spheres as in riemann_hard_spheres.hpp]. The reservoirs
// of internal energy lose their share 1 - 3 (gamma - 1) / 2 of it, which is measured without telling motion from heat.
//
// Tolerance: (1) the sum of N exponential reservoirs scatters by sqrt(N) kT a sample: four standard errors. (2) Where
// collisions are rarer than 20 times the rate of thinning, D ln rho / Dt = 2 / ((gamma + 1) t), flow leaves equilibrium
// [Bird, Molecular Gas Dynamics (1994), sec. 1.4: P = 0.05]: at most all heat the fan would still lose from there on is
// kept. A gas of gamma 5/3 in motion, with idle reservoirs, would lose nothing from them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/particles_gas_scenes.hpp"
#include "tests/verification/riemann_hard_spheres.hpp"

namespace standoff::particles {
namespace {

constexpr double width = 0.1, fill = 0.2, depth = 0.5, pi = 3.141592653589793;
constexpr int across = 10, layers = 60, samples = 2;
constexpr double count = across * across * layers, radius3 = 3 * fill * depth * width * width / (4 * pi * count);

GasState layer_at_rest(std::uint64_t seed) {
  GasState gas;
  gas.mass = 1.0, gas.gamma = 1.4, gas.radius = std::cbrt(radius3);
  for (int k = 0; k < across * across * layers; ++k) {
    const auto id = static_cast<std::uint32_t>(k);
    CounterRandom random(seed, RandomUse::test, id);
    gas.position.push_back({(k % across + 0.5) * width / across, (k / across % across + 0.5) * width / across,
                            (k / across / across + 0.5) * depth / layers});
    const double x = random.normal(), y = random.normal(), z = random.normal();
    gas.velocity.push_back({x, y, z});
    gas.internal_energy.push_back(-std::log(random.uniform()));  // two degrees of freedom, kT = 1
    gas.id.push_back(id);
  }
  gas.plate_rebound.assign(gas.size(), std::numeric_limits<double>::quiet_NaN());
  return gas;
}

double reservoirs(const GasState& gas) {
  return gas_totals(gas).internal;
}

/// What the fan takes from the reservoirs until `time`, and what of it is lost beyond the breakdown of equilibrium.
struct FanLoss {
  double all = 0.0, beyond = 0.0;  // J
};
FanLoss fan_loss(double time) {
  const test::HardSphereGas gas{1.4, 4 * pi / 3 * radius3};
  const double rho0 = count / (depth * width * width), area = width * width, step = 1e-3;
  FanLoss loss;
  double rho = rho0, t = 1.0, u = 0.0, xi = -gas.sound(rho, t), frozen = 0.0;
  while (rho > 1e-6 * rho0) {
    const double next = rho * (1 - step), t_next = t * (1 - 0.4 * gas.z(rho) * step);
    u += gas.sound(rho, t) * step;
    const double xi_next = u - gas.sound(next, t_next), particles = rho * area * (xi_next - xi) * time;
    // Rate of collisions of a particle, 4 sqrt(pi) d^2 n sqrt(kT/m) [Bird 1994, eq. 4.64 for hard spheres].
    const double rate = 16 * std::sqrt(pi) * std::pow(radius3, 2.0 / 3) * rho * std::sqrt(t);
    if (frozen == 0.0 && rate < 20 * 2 / (2.4 * time)) frozen = t;
    loss.all += particles * (1 - t);
    if (frozen > 0.0) loss.beyond += particles * (frozen - t);
    rho = next, t = t_next, xi = xi_next;
  }
  return loss;
}

TEST(FreeExpansion_IntoVacuum, ReservoirsPayTheirShareOfTheFan) {
  const double end =
      0.8 * depth / test::HardSphereGas{1.4, 4 * pi / 3 * radius3}.sound(count / (depth * width * width), 1.0);
  double lost = 0.0;
  for (std::uint64_t seed = 1; seed <= samples; ++seed) {
    GasState gas = layer_at_rest(seed);
    GasCollideOptions options;
    options.seed = seed,
    options.walls = reflecting_planes(false, true, {0, 0, 0}, {width, width, ReflectingPlanes::none});
    GasCollide collide(options);
    GasCollideCounts counts;
    const double before = reservoirs(gas);
    double h = 0.0;
    std::uint32_t step = 0;
    for (double time = 0.0; time < end; ++step) {
      h = collide.suggest_step(gas, counts, h, 0.01);
      const double now = std::min(h, end - time);
      counts = collide.run(gas, nullptr, nullptr, now, step);
      gas_drift(gas, nullptr, nullptr, now);
      time += now;
    }
    lost += (before - reservoirs(gas)) / samples;
  }
  const FanLoss exact = fan_loss(end);
  RecordProperty("lost",
                 fmt::format("{:.0f} of {:.0f}, of which beyond breakdown {:.0f}", lost, exact.all, exact.beyond));
  const double scatter = 4 * std::sqrt(count / samples);
  EXPECT_LT(lost, exact.all + scatter) << "J";
  EXPECT_GT(lost, exact.all - exact.beyond - scatter) << "J";
  EXPECT_LT(exact.beyond, 0.2 * exact.all) << "the bound must tell gamma";
}

}  // namespace
}  // namespace standoff::particles
