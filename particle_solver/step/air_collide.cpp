#include "particle_solver/step/air_collide.hpp"

#include <algorithm>

#include "particle_solver/kernels/collision_pairs.hpp"
#include "particle_solver/kernels/gas_pair_impulse.hpp"
#include "particle_solver/kernels/larsen_borgnakke.hpp"

namespace standoff::particles {
namespace {

using Members = std::span<const std::uint32_t>;

double zeta_of(const GasState& gas) {
  return gas.internal_energy.empty() ? 0.0 : internal_degrees_of_freedom(gas.gamma);
}

/// Particle i of `a` and j of `b` meet as hard spheres of random orientation; `closing` = v_j - v_i.
void meet(GasState& a, std::uint32_t i, GasState& b, std::uint32_t j, const Vec3& closing, double zeta_a, double zeta_b,
          CounterRandom& random) {
  const Vec3 n = random_line_of_centres(closing, random);
  const double mu = reduced_mass(1.0 / a.mass, 1.0 / b.mass), before = dot(closing, n);
  double after = -before;
  if (zeta_a + zeta_b > 0.0) {
    const EnergyExchange exchange =
        larsen_borgnakke_unlike(mu, before, a.internal_energy[i], b.internal_energy[j], zeta_a, zeta_b, random);
    after = exchange.normal_velocity;
    a.internal_energy[i] = exchange.energy_i, b.internal_energy[j] = exchange.energy_j;
  }
  const Vec3 impulse = n * pair_impulse(mu, before, after);
  a.velocity[i] -= impulse / a.mass, b.velocity[j] += impulse / b.mass;
}

double fastest(const GasState& gas, Members members, const Vec3& about) {
  double square = 0.0;
  for (const std::uint32_t i : members) square = std::max(square, squared_norm(gas.velocity[i] - about));
  return std::sqrt(square);
}

}  // namespace

void AirCollide::collide_cell(Air& air, GasState* products, std::uint32_t cell, double dt, std::uint32_t step,
                              long& done) const {
  GasState& points = air.particles;
  const Members members = air_.in(cell);
  const Members others = products != nullptr ? products_.in(cell) : Members{};
  if (members.size() + others.size() < 2) return;
  CounterRandom random(seed_, RandomUse::air_collision, cell, 0, step);
  Vec3 mean;
  for (const std::uint32_t i : members) mean += points.velocity[i];
  mean *= 1.0 / static_cast<double>(members.size());
  const double spread = fastest(points, members, mean), zeta = zeta_of(points);
  const auto count = static_cast<double>(members.size());

  const double bound = 2.0 * spread;
  const long among =
      whole_with_mean(candidates_among(count, air.cross_section * bound * dt, air.cells.volume()), random);
  for (long k = 0; k < among; ++k) {
    const std::size_t a = pick(members.size(), random), b = pick(members.size() - 1, random);
    const std::uint32_t i = members[a], j = members[b < a ? b : b + 1];
    const Vec3 closing = points.velocity[j] - points.velocity[i];
    const double speed = norm(closing);
    if (!(random.uniform() * bound < speed)) continue;
    meet(points, i, points, j, closing, zeta, zeta, random);
    points.disturbed[i] = points.disturbed[j] = points.disturbed[i] | points.disturbed[j];
    ++done;
  }
  if (others.empty()) return;
  const double both = spread + fastest(*products, others, mean), zeta_products = zeta_of(*products);
  const double swept = unlike_cross_section(air.cross_section, points.mass, products->mass) * both * dt;
  const long between =
      whole_with_mean(candidates_between(count, static_cast<double>(others.size()), swept, air.cells.volume()), random);
  for (long k = 0; k < between; ++k) {
    const std::uint32_t i = members[pick(members.size(), random)], j = others[pick(others.size(), random)];
    const Vec3 closing = products->velocity[j] - points.velocity[i];
    if (!(random.uniform() * both < norm(closing))) continue;
    meet(points, i, *products, j, closing, zeta, zeta_products, random);
    points.disturbed[i] = 1;
    ++done;
  }
}

void AirCollide::run(Air& air, GasState* products, double dt, std::uint32_t step) {
  if (air.particles.size() == 0) return;
  air.cells.sort(
      air.particles.position, [](std::size_t) { return true; }, air_);
  if (products != nullptr)
    air.cells.sort(
        products->position, [&](std::size_t i) { return products->all_released() || products->released[i] != 0; },
        products_);
  const auto cells = static_cast<std::ptrdiff_t>(air.cells.count());
  long done = 0;
#pragma omp parallel for num_threads(threads_) schedule(dynamic, 512) reduction(+ : done)
  for (std::ptrdiff_t c = 0; c < cells; ++c) {
    const auto cell = static_cast<std::uint32_t>(c);
    if (!air_.in(cell).empty()) collide_cell(air, products, cell, dt, step, done);
  }
  collisions_ += done;
}

}  // namespace standoff::particles
