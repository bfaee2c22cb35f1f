// Law: a ball of C-4 that goes off at once in air drives a spherical blast wave; a finite-volume solution of the same
// two gases (spherical_blast.hpp) says how much energy the products have given to the air and where the shock is.
// Tolerance: partners of a collision are drawn from a cell, so contact and shock are known to a cell: the shock to one
// cell, the energy to what the products give while the contact moves by one. Seeds scatter by 0.2 % in energy, twice
// the zones change the reference by 0.1 %. The radial momentum of products and air differs by 5 % and 9 %; that is not
// asserted: products this thin no longer meet each other, and have no pressure across the radius as a continuum has.
//
// The reference itself: a point blast in cold air, Sedov's R = 1.0328 (E t^2 / rho)^(1/5) for gamma 1.4 [Sedov,
// Similarity and Dimensional Methods in Mechanics, 1959, ch. IV.11; Kamm, LA-UR-00-6055, 2000: alpha 0.8511, R = (E t^2
// / alpha rho)^(1/5)]; a shock of four zones of 1 % of its radius: 2 %. Its energy is kept to 0.1 %, the order of its
// step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_solver/packing/charge.hpp"
#include "particle_solver/step/detonate.hpp"
#include "particle_solver/step/gas_collide.hpp"
#include "particle_solver/step/gas_drift.hpp"
#include "tests/unit/particles_air_scenes.hpp"
#include "tests/verification/spherical_blast.hpp"

namespace standoff::particles {
namespace {

constexpr double outer = 0.36, cell = 0.009, pi = 3.141592653589793;

ChargeSpec c4(long particles) {
  ChargeSpec charge;
  charge.present = true;
  charge.explosive = {"c4", 1601.0, 8.7e9, 1.4, 0.20, 8190.0};
  charge.mass = 0.150, charge.radius = std::cbrt(3 * 0.150 / (4 * pi * 1601.0)), charge.particles = particles;
  return charge;
}

test::BlastOptions blast_options(const ChargeSpec& charge) {
  test::BlastOptions o;
  o.radius = charge.radius, o.density = charge.explosive.density;
  o.energy = charge.explosive.energy / charge.explosive.density;
  o.covolume = charge.explosive.fill / charge.explosive.density;
  o.air_density = 1.3, o.air_energy = 101300.0 / 0.4 / 1.3, o.outer = outer;
  return o;
}

double radial(const GasState& gas) {
  double sum = 0.0;
  for (std::size_t i = 0; i < gas.size(); ++i)
    sum += gas.mass * dot(gas.velocity[i], gas.position[i]) / norm(gas.position[i]);
  return sum;
}

/// A quarter of the sphere about the origin; calls at(time index) when each of `times` is reached.
template <class At>
void run_sphere(std::uint64_t seed, const std::vector<double>& times, At&& at) {
  GasState gas = build_charge(c4(40000), {0, 0, 0}, 4, seed);
  std::fill(gas.release_time.begin(), gas.release_time.end(), 0.0);
  auto air = air_in({{0, 0, -outer}, {outer, outer, outer}, cell, 2.0});
  AirCellsOptions cells{{0, 0, -outer}, {outer, outer, outer}, cell, 0.0, 0.0, true, false};
  air->cells = AirCells(cells);
  air->body_radius = c4(1).radius, air->particles.radius = 0.01 * cell;
  GasCollideOptions options;
  options.mirrors.on = true, options.seed = seed;
  GasCollide collide(options);
  AirCollide air_collide(seed, 1);
  AirDrift air_drift(reflecting_planes(true, false, {}, {}), 1);
  AirBoundaries edge(AirBoundariesOptions{seed, false});
  Boundaries exits({{0, 0, -outer}, {outer, outer, outer}, true, 1});
  BoundaryBooks books;
  GasCollideCounts counts;
  double time = 0.0, gas_step = 0.0;
  std::uint32_t number = 0, sub_step = 0;
  for (std::size_t k = 0; k < times.size();) {
    double fastest = 1.0;
    for (const auto* one : {&gas, &air->particles})
      for (const Vec3& v : one->velocity) fastest = std::max(fastest, norm(v));
    const double window = std::min(cell / fastest, times[k] - time);
    detonate(gas, time);
    air_collide.run(*air, &gas, window, ++number);
    air_drift.run(*air, nullptr, nullptr, window);
    edge.run(*air, &gas, nullptr, nullptr, exits, books, window, number);
    for (double done = 0.0; done < window * (1 - 1e-9);) {
      gas_step = collide.suggest_step(gas, counts, gas_step, window);
      const double h = std::min(gas_step, window - done);
      counts = collide.run(gas, nullptr, nullptr, h, ++sub_step);
      gas_drift(gas, nullptr, nullptr, h);
      done += h;
    }
    time += window;
    if (time >= times[k] * (1 - 1e-9)) at(k++, gas, air->particles);
  }
}

/// Radius where the air, in shells of 2 mm, moves with half of its largest mean speed.
double shock_radius(const GasState& air) {
  std::vector<double> speed(200), count(200);
  for (std::size_t i = 0; i < air.size(); ++i) {
    const double r = norm(air.position[i]);
    const auto shell = static_cast<std::size_t>(std::min(199.0, r / 2e-3));
    speed[shell] += dot(air.velocity[i], air.position[i]) / r, count[shell] += 1;
  }
  double most = 0.0;
  for (std::size_t s = 0; s < speed.size(); ++s) {
    speed[s] = count[s] > 20 ? speed[s] / count[s] : 0.0;  // the first shells hold no air
    most = std::max(most, speed[s]);
  }
  std::size_t s = speed.size() - 1;
  while (speed[s] < 0.5 * most) --s;
  return 2e-3 * static_cast<double>(s + 1);
}

TEST(BlastSphere_C4InAir, GivesTheAirWhatTheFiniteVolumesSay) {
  const std::vector<double> times = {20e-6, 40e-6, 60e-6};
  const double energy = 0.150 * 8.7e9 / 1601.0;
  test::SphericalBlast exact(blast_options(c4(1))), later(blast_options(c4(1)));
  const double all = exact.total_energy();
  run_sphere(1, times, [&](std::size_t k, const GasState& gas, const GasState& air) {
    exact.advance_to(times[k]), later.advance_to(times[k] + 1e-6);
    const double slope = (exact.ball_energy() - later.ball_energy()) / (later.contact() - exact.contact());
    const double kept = 4.0 * gas_totals(gas).energy(), shock = shock_radius(air);
    const std::string text = fmt::format(
        "{:.0f} us: energy of the products {:.4f} of {:.4f}, momentum {:.1f} of {:.1f}, of the air {:.1f} of {:.1f} kg "
        "m/s, "
        "shock {:.1f} of {:.1f} mm, contact {:.1f} mm",
        times[k] * 1e6, kept / energy, exact.ball_energy() / energy, 4.0 * radial(gas), exact.radial_momentum(true),
        4.0 * radial(air), exact.radial_momentum(false), shock * 1e3, exact.shock() * 1e3, exact.contact() * 1e3);
    RecordProperty(fmt::format("at_{:.0f}_us", times[k] * 1e6), text);
    EXPECT_NEAR(kept, exact.ball_energy(), slope * cell) << text;
    EXPECT_NEAR(shock, exact.shock(), cell) << text;
    EXPECT_NEAR(exact.total_energy() / all, 1.0, 1e-3);
  });
}

TEST(SphericalBlast_PointSource, RunsAsSedovSays) {
  test::BlastOptions o;
  o.radius = 0.005, o.density = 1.3, o.air_density = 1.3, o.air_energy = 1.0, o.outer = 0.5;
  o.energy = 1e5 / (o.density * 4.0 / 3.0 * pi * std::pow(o.radius, 3)), o.ball_zones = 5;
  test::SphericalBlast blast(o);
  for (const double time : {1e-4, 2e-4}) {
    blast.advance_to(time);
    const double exact = std::pow(1e5 * time * time / (0.8511 * 1.3), 0.2);
    EXPECT_NEAR(blast.shock() / exact, 1.0, 0.02) << blast.shock() << " m";
  }
}

}  // namespace
}  // namespace standoff::particles
