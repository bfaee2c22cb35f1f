#include "particle_solver/packing/charge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/stop.hpp"
#include "particle_solver/kernels/gamma_variate.hpp"
#include "particle_solver/kernels/larsen_borgnakke.hpp"
#include "particle_solver/packing/charge_positions.hpp"

namespace standoff::particles {
namespace {

constexpr double largest_fill =
    0.45;  // beyond lie freezing (0.494) and packings that do not relax; also tested up to here

/// Fill of what the centres of the spheres leave: a cylinder keeps whole spheres within its radius.
double packed_fill(const ChargeSpec& charge, double sphere_radius) {
  const double share = charge.length > 0.0 ? 1.0 - sphere_radius / charge.radius : 1.0;
  return charge.explosive.fill / (share * share);
}

void check(const ChargeSpec& charge, int copies, long count) {
  const Explosive& explosive = charge.explosive;
  const auto refuse = [](const std::string& text) { throw Stop(ExitCode::bad_case, text); };
  if (count < 2)
    refuse(
        fmt::format("charge: {} particles in {} copies leave {} to simulate; at least 2 are needed: raise "
                    "charge.particles",
                    charge.particles, copies, count));
  if (!(explosive.fill > 0.0 && explosive.fill <= largest_fill))
    refuse(
        fmt::format("charge: the fill fraction of explosive {} is {}; spheres are packed for 0 < fill <= {}: lower it",
                    explosive.name, explosive.fill, largest_fill));
  if (!(explosive.gamma > 1.0 && internal_degrees_of_freedom(explosive.gamma) >= 0.0))
    refuse(fmt::format("charge: gamma of explosive {} is {}; a gas of spheres needs 1 < gamma <= 5/3", explosive.name,
                       explosive.gamma));
  if (!(charge.mass > 0.0 && charge.radius > 0.0 && explosive.density > 0.0 && explosive.energy > 0.0))
    refuse(fmt::format("charge: mass {} kg, radius {} m, density {} kg/m3 and energy {} J/m3 must all be positive",
                       charge.mass, charge.radius, explosive.density, explosive.energy));
}

/// Pairs v, -v; an odd count closes with three velocities of equal size 120 degrees apart.
void draw_velocities(GasState& gas, double kinetic, std::uint64_t seed) {
  const std::size_t count = gas.size(), in_pairs = count % 2 == 0 ? count : count - 3;
  const auto draw = [&](std::size_t i) {
    CounterRandom random(seed, RandomUse::gas_velocity, gas.id[i]);
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return Vec3{x, y, z};
  };
  for (std::size_t i = 0; i < in_pairs; i += 2) {
    gas.velocity[i] = draw(i);
    gas.velocity[i + 1] = -gas.velocity[i];
  }
  if (in_pairs < count) {
    const Vec3 v = draw(in_pairs), other = draw(in_pairs + 1);
    const Vec3 across = cross(v, other);
    const Vec3 side = across / norm(across);
    const Vec3 turned = cross(side, v) * (0.5 * std::sqrt(3.0));
    gas.velocity[in_pairs] = v;
    gas.velocity[in_pairs + 1] = v * -0.5 + turned;
    gas.velocity[in_pairs + 2] = v * -0.5 - turned;
  }
  double sum = 0.0;
  for (const Vec3& v : gas.velocity) sum += 0.5 * gas.mass * squared_norm(v);
  const double scale = std::sqrt(kinetic / sum);
  for (Vec3& v : gas.velocity) v *= scale;
}

void draw_internal_energies(GasState& gas, double internal, std::uint64_t seed) {
  gas.internal_energy.assign(gas.size(), 0.0);
  const double zeta = internal_degrees_of_freedom(gas.gamma);
  if (zeta == 0.0) return;
  double sum = 0.0;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    CounterRandom random(seed, RandomUse::internal_energy, gas.id[i]);
    sum += gas.internal_energy[i] = gamma_variate(0.5 * zeta, random);
  }
  for (double& e : gas.internal_energy) e *= internal / sum;
}

}  // namespace

GasState build_charge(const ChargeSpec& charge, const Vec3& centre, int copies, std::uint64_t seed) {
  const Explosive& explosive = charge.explosive;
  const long particles = charge.particles / copies;
  check(charge, copies, particles);
  const auto count = static_cast<std::size_t>(particles);
  const double volume = charge.mass / explosive.density / copies;  // of explosive, simulated part

  GasState gas;
  gas.mass = charge.mass / copies / static_cast<double>(count);
  gas.radius = std::cbrt(3.0 * explosive.fill * volume / (4.0 * 3.141592653589793 * static_cast<double>(count)));
  if (const double fill = packed_fill(charge, gas.radius); !(gas.radius < charge.radius && fill <= largest_fill))
    throw Stop(
        ExitCode::bad_case,
        fmt::format("charge: {} spheres of radius {:.3g} mm within a cylinder of radius {:.3g} mm fill {:.2f} of "
                    "what is open to them; at most {} packs: raise charge.particles",
                    charge.particles, 1e3 * gas.radius, 1e3 * charge.radius, fill, largest_fill));
  gas.gamma = explosive.gamma;
  gas.position = charge_positions({count, charge.radius, charge.length, gas.radius, copies == 4, seed});
  gas.position.shrink_to_fit();
  for (Vec3& x : gas.position) x += centre;
  gas.id.resize(count);
  for (std::size_t i = 0; i < count; ++i) gas.id[i] = static_cast<std::uint32_t>(i);

  const double energy = explosive.energy * volume, share = translational_share(explosive.gamma);
  gas.velocity.resize(count);
  draw_velocities(gas, share * energy, seed);
  draw_internal_energies(gas, (1.0 - share) * energy, seed);
  gas.released.assign(count, 0);
  gas.release_time.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    gas.release_time[i] = norm(gas.position[i] - charge.detonator) / explosive.detonation_speed;
  return gas;
}

}  // namespace standoff::particles
