// Law: Sod's problem (a membrane between dense and thin gas at rest breaks) has an exact solution; here for the hard-
// sphere gas itself, riemann_hard_spheres.hpp: density 4 : 1 at equal temperature, gamma 1.4, fills 0.12 and 0.03. A
// tube 1 m long and 0.06 m wide between specular walls, 14000 spheres, six samples, bands at t = 0.16 s. Compared:
// - pressure n T Z(f) and velocity on both sides of the contact, which conduction between the sides leaves alone;
// - number ahead of the fan, and in a band across the shock: how far it ran, however thick it is;
// - temperature behind the fan: gamma 5/3 would miss it by 16 %.
// Tolerance: four standard errors (number sqrt(n), velocity sqrt(T / n), temperature sqrt(2 / 3n)) and, for what lies
// between the waves, what a mean free path of 0.012 m on the thin side does: waves smeared over a few of them in a
// field 0.2 m long, 2 %, and 4 % of the temperature within a diffusion length, sqrt(4 D t) = 0.04 m, of the contact.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/particles_gas_scenes.hpp"
#include "tests/verification/riemann_hard_spheres.hpp"

namespace standoff::particles {
namespace {

constexpr double width = 0.06, fill = 0.12, end = 0.16;
constexpr int samples = 6;

/// n x n spheres a layer between z0 and z0 + 0.5, velocity components of unit variance.
void add_lattice(GasState& gas, int n, int layers, double z0, std::uint64_t seed) {
  for (int k = 0; k < n * n * layers; ++k) {
    const auto id = static_cast<std::uint32_t>(gas.id.size());
    CounterRandom random(seed, RandomUse::test, id);
    gas.position.push_back(
        {(k % n + 0.5) * width / n, (k / n % n + 0.5) * width / n, z0 + (k / n / n + 0.5) * 0.5 / layers});
    const double x = random.normal(), y = random.normal(), z = random.normal();
    gas.velocity.push_back({x, y, z});
    gas.internal_energy.push_back(-std::log(random.uniform()) * gas.mass);  // two degrees of freedom
    gas.id.push_back(id);
  }
}

GasState tube_gas(std::uint64_t seed) {
  GasState gas;
  gas.mass = 1.0, gas.gamma = 1.4;
  gas.radius = std::cbrt(3.0 * fill * 0.5 * width * width / (4.0 * 3.141592653589793 * 11 * 11 * 92));
  add_lattice(gas, 11, 92, 0.0, seed);
  add_lattice(gas, 7, 58, 0.5, seed);
  gas.plate_rebound.assign(gas.size(), 0.0);
  return gas;
}

void reflect(double& x, double& v, double low, double high) {
  if (x < low) x = 2 * low - x, v = std::fabs(v);
  if (x > high) x = 2 * high - x, v = -std::fabs(v);
}

GasState gas_at_end(std::uint64_t seed) {
  GasState gas = tube_gas(seed);
  GasCollideOptions options;
  options.mirrors.on = true, options.seed = seed;
  GasCollide collide(options);
  GasCollideCounts counts;
  double h = 0.0, time = 0.0;
  for (std::uint32_t step = 0; time < end; ++step) {
    h = collide.suggest_step(gas, counts, h, 1.0);
    const double now = std::min(h, end - time);
    counts = collide.run(gas, nullptr, nullptr, now, step);
    gas_drift(gas, nullptr, nullptr, now);
    for (std::size_t i = 0; i < gas.size(); ++i) {
      reflect(gas.position[i].x, gas.velocity[i].x, -1.0, width);
      reflect(gas.position[i].y, gas.velocity[i].y, -1.0, width);
      reflect(gas.position[i].z, gas.velocity[i].z, 0.0, 1.0);
    }
    time += h;
  }
  return gas;
}

double sphere(double radius) {
  return 4.0 / 3.0 * 3.141592653589793 * std::pow(radius, 3);
}

/// What the tube is wide for the bulk of the fluid: at a wall of centres it is denser, as if the wall stood 3 f r / (1
/// + 2 f) farther out (scaled particle theory, see step/gas_search.cpp).
double section(double density, double radius) {
  const double f = density * sphere(radius), side = width + 2 * 3 * f * radius / (1 + 2 * f);
  return side * side;
}

/// Density [1/m3] of the bulk of `count` spheres in a length of tube.
double bulk_density(double count, double length, double radius) {
  double density = count / (length * width * width);
  for (int k = 0; k < 20; ++k) density = count / (length * section(density, radius));
  return density;
}

struct Band {
  double low, high;                            // m
  double count = 0, velocity = 0, square = 0;  // sums over the particles of all samples
  double mean() const { return velocity / count; }
  double temperature() const { return (square / count - mean() * mean()) / 3; }
  double pressure(const test::HardSphereGas& gas, double radius) const {
    return gas.pressure(bulk_density(count / samples, high - low, radius), temperature());
  }
};

Band exact_band(const test::ShockTube& tube, const Band& band, double radius) {
  Band exact{band.low, band.high};
  constexpr int parts = 500;
  for (int k = 0; k < parts; ++k) {
    const test::GasPoint point = tube.at((band.low + (band.high - band.low) * (k + 0.5) / parts - 0.5) / end);
    const double n = point.rho * section(point.rho, radius) * (band.high - band.low) / parts * samples;
    exact.count += n, exact.velocity += n * point.u, exact.square += n * (3 * point.t + point.u * point.u);
  }
  return exact;
}

void add_to(std::vector<Band>& bands, const GasState& gas) {
  for (Band& band : bands)
    for (std::size_t i = 0; i < gas.size(); ++i) {
      if (gas.position[i].z < band.low || gas.position[i].z >= band.high) continue;
      const Vec3& v = gas.velocity[i];
      band.count += 1, band.velocity += v.z, band.square += squared_norm(v);
    }
}

TEST(ShockTube_HardSphereGas_FollowsTheExactRiemannSolution, InEveryBand) {
  std::vector<Band> bands = {{0.0, 0.15}, {0.46, 0.56}, {0.67, 0.73}, {0.7, 1.0}};
  for (std::uint64_t seed = 1; seed <= samples; ++seed) add_to(bands, gas_at_end(seed));
  const double radius = tube_gas(1).radius, left = bulk_density(11 * 11 * 92, 0.5, radius),
               right = bulk_density(7 * 7 * 58, 0.5, radius);
  const test::ShockTube tube = test::solve_shock_tube({1.4, sphere(radius)}, {left, 1.0, 0.0}, {right, 1.0, 0.0});
  for (const Band& band : bands) {
    const Band exact = exact_band(tube, band, radius);
    const bool between_waves = &band == &bands[1] || &band == &bands[2];
    const double smear = between_waves ? 0.02 : 0.0, n = exact.count;
    const std::string text = fmt::format(
        "{:.2f} to {:.2f} m: {:.0f} of {:.0f} particles, velocity {:.3f} of {:.3f} m/s, temperature {:.3f} of {:.3f}, "
        "pressure {:.0f} of {:.0f}",
        band.low, band.high, band.count, n, band.mean(), exact.mean(), band.temperature(), exact.temperature(),
        band.pressure(tube.gas, radius), exact.pressure(tube.gas, radius));
    RecordProperty(fmt::format("band_{:.0f}", 100 * band.low), text);
    EXPECT_NEAR(band.mean(), exact.mean(), 4 * std::sqrt(exact.temperature() / n) + smear * exact.mean()) << text;
    if (!between_waves) {
      EXPECT_NEAR(band.count, n, 4 * std::sqrt(n)) << text;
      continue;
    }
    EXPECT_NEAR(band.pressure(tube.gas, radius) / exact.pressure(tube.gas, radius), 1.0,
                4 * std::sqrt(5 / (3 * n)) + smear)
        << text;
  }
  const Band exact = exact_band(tube, bands[1], radius);
  EXPECT_NEAR(bands[1].temperature() / exact.temperature(), 1.0, 0.04 + 4 * std::sqrt(2 / (3 * exact.count)));
}

}  // namespace
}  // namespace standoff::particles
