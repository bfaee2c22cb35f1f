#include "particle_solver/packing/charge_positions.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "coupling/base/counter_random.hpp"
#include "coupling/base/stop.hpp"
#include "particle_solver/search/gas_cell_grid.hpp"

namespace standoff::particles {
namespace {

constexpr double two_pi = 6.283185307179586;
constexpr double oversize = 1.01;
constexpr int most_sweeps = 20000;

double fraction(double x) {
  return x - std::floor(x);
}

std::vector<Vec3> spread(const ChargePositions& wanted) {
  constexpr double g = 1.2207440846057594754;  // positive root of g^4 = g + 1
  CounterRandom shift(wanted.seed, RandomUse::gas_position, 0xFFFFFFFFu);
  const double s0 = shift.uniform(), s1 = shift.uniform(), s2 = shift.uniform();
  const double jitter = std::cbrt(1.0 / static_cast<double>(wanted.count)) / 3.0;
  std::vector<Vec3> centre(wanted.count);
  for (std::size_t i = 0; i < wanted.count; ++i) {
    CounterRandom random(wanted.seed, RandomUse::gas_position, static_cast<std::uint32_t>(i));
    const double n = static_cast<double>(i);
    const auto coordinate = [&](double s, double step) {
      return fraction(s + n * step + jitter * (random.uniform() - 0.5));
    };
    const double u = coordinate(s0, 1.0 / g), v = coordinate(s1, 1.0 / (g * g)), w = coordinate(s2, 1.0 / (g * g * g));
    const double r = wanted.ball_radius * std::cbrt(u), z = 1.0 - 2.0 * v, across = std::sqrt(1.0 - z * z);
    const double angle = w * (wanted.quarter ? 0.25 * two_pi : two_pi);
    centre[i] = {r * across * std::cos(angle), r * across * std::sin(angle), r * z};
  }
  return centre;
}

void keep_inside(const ChargePositions& wanted, Vec3& x) {
  if (wanted.quarter) {
    x.x = std::max(x.x, wanted.sphere_radius);
    x.y = std::max(x.y, wanted.sphere_radius);
  }
  const double distance = norm(x);
  if (distance <= wanted.ball_radius) return;
  // Towards the centre, or along the mirror planes where the way to the centre would leave them.
  x *= wanted.ball_radius / distance;
  if (!wanted.quarter) return;
  x.x = std::max(x.x, wanted.sphere_radius);
  x.y = std::max(x.y, wanted.sphere_radius);
  const double left = wanted.ball_radius * wanted.ball_radius - x.x * x.x - x.y * x.y;
  if (left >= 0.0) x.z = std::clamp(x.z, -std::sqrt(left), std::sqrt(left));
}

/// One sweep; returns the smallest distance of two centres before it [m].
double sweep(const ChargePositions& wanted, GasCellGrid& grid, std::vector<Vec3>& centre, std::vector<Vec3>& sorted) {
  const double contact = 2.0 * wanted.sphere_radius * oversize;
  grid.sort(centre);
  sorted.resize(centre.size());
  for (std::size_t p = 0; p < sorted.size(); ++p) sorted[p] = centre[grid.order()[p]];
  double smallest = contact * contact;
  for (std::size_t p = 0; p < sorted.size(); ++p) {
    const Vec3 me = sorted[p];
    Vec3 move;
    grid.visit<false>(me, contact, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t q = begin; q < end; ++q) {
        const Vec3 gap = me - sorted[q];
        const double square = squared_norm(gap);
        if (square >= contact * contact || q == p) continue;
        smallest = std::min(smallest, square);
        const double distance = std::sqrt(square);
        if (distance > 0.0) move += gap * (0.5 * (contact - distance) / distance);
      }
    });
    centre[p] = me + move;
    keep_inside(wanted, centre[p]);
  }
  return std::sqrt(smallest);
}

}  // namespace

std::vector<Vec3> charge_positions(const ChargePositions& wanted) {
  if (wanted.quarter && wanted.ball_radius < 2.0 * wanted.sphere_radius)
    throw Stop(ExitCode::bad_case,
               fmt::format("charge: spheres of radius {} m are too large for a quarter of a ball of radius {} m: raise "
                           "charge.particles or simulate the full charge",
                           wanted.sphere_radius, wanted.ball_radius));
  std::vector<Vec3> centre = spread(wanted), sorted;
  for (Vec3& x : centre) keep_inside(wanted, x);
  GasCellGrid grid;
  grid.shape(wanted.count, 2.0 * wanted.sphere_radius * oversize);
  for (int sweeps = 0; sweeps < most_sweeps; ++sweeps)
    if (sweep(wanted, grid, centre, sorted) >= 2.0 * wanted.sphere_radius * (1.0 + 1e-9)) return sorted;
  throw Stop(
      ExitCode::bad_case,
      fmt::format("charge: {} spheres of radius {} m still overlap in a ball of radius {} m after {} sweeps; lower "
                  "the fill fraction",
                  wanted.count, wanted.sphere_radius, wanted.ball_radius, most_sweeps));
}

}  // namespace standoff::particles
