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

/// Radius within which centres lie, m.
double centre_limit(const ChargePositions& wanted) {
  return wanted.length > 0.0 ? wanted.radius - wanted.sphere_radius : wanted.radius;
}

/// The point of the body at u, v, w in [0, 1): equal volumes go to equal volumes.
Vec3 point_at(const ChargePositions& wanted, double u, double v, double w) {
  const double angle = two_pi * w;
  if (wanted.length > 0.0) {
    const double r = centre_limit(wanted) * std::sqrt(u);
    return {r * std::cos(angle), r * std::sin(angle), wanted.length * (v - 0.5)};
  }
  const double r = centre_limit(wanted) * std::cbrt(u), z = 1.0 - 2.0 * v, across = std::sqrt(1.0 - z * z);
  return {r * across * std::cos(angle), r * across * std::sin(angle), r * z};
}

std::vector<Vec3> spread(const ChargePositions& wanted, std::size_t count) {
  constexpr double g = 1.2207440846057594754;  // positive root of g^4 = g + 1
  CounterRandom shift(wanted.seed, RandomUse::gas_position, 0xFFFFFFFFu);
  const double s0 = shift.uniform(), s1 = shift.uniform(), s2 = shift.uniform();
  const double jitter = std::cbrt(1.0 / static_cast<double>(count)) / 3.0;
  std::vector<Vec3> centre(count);
  for (std::size_t i = 0; i < count; ++i) {
    CounterRandom random(wanted.seed, RandomUse::gas_position, static_cast<std::uint32_t>(i));
    const double n = static_cast<double>(i);
    const auto coordinate = [&](double s, double step) {
      return fraction(s + n * step + jitter * (random.uniform() - 0.5));
    };
    const double u = coordinate(s0, 1.0 / g), v = coordinate(s1, 1.0 / (g * g)), w = coordinate(s2, 1.0 / (g * g * g));
    centre[i] = point_at(wanted, u, v, w);
  }
  return centre;
}

void keep_inside(const ChargePositions& wanted, Vec3& x) {
  const bool cylinder = wanted.length > 0.0;
  const double limit = centre_limit(wanted), distance = cylinder ? std::hypot(x.x, x.y) : norm(x);
  const double scale = distance > limit ? limit / distance : 1.0;
  x.x *= scale, x.y *= scale;
  x.z = cylinder ? std::clamp(x.z, -0.5 * wanted.length, 0.5 * wanted.length) : x.z * scale;
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

std::vector<Vec3> packed_body(const ChargePositions& wanted, std::size_t count) {
  std::vector<Vec3> centre = spread(wanted, count), sorted;
  GasCellGrid grid;
  grid.shape(count, 2.0 * wanted.sphere_radius * oversize);
  for (int sweeps = 0; sweeps < most_sweeps; ++sweeps)
    if (sweep(wanted, grid, centre, sorted) >= 2.0 * wanted.sphere_radius * (1.0 + 1e-9)) return sorted;
  throw Stop(
      ExitCode::bad_case,
      fmt::format("charge: {} spheres of radius {} m still overlap in a {} of radius {} m after {} sweeps; lower the "
                  "fill fraction",
                  count, wanted.sphere_radius, wanted.length > 0.0 ? "cylinder" : "ball", wanted.radius, most_sweeps));
}

/// The angle about z from which the next right angle holds exactly a quarter of the centres. One exists: as the angle
/// goes round, the number changes by one at a time, and over the four quarters its mean is a quarter of all.
double angle_of_fair_quarter(const std::vector<Vec3>& centre) {
  const std::size_t count = centre.size(), quarter = count / 4;
  std::vector<double> angle(count);
  for (std::size_t i = 0; i < count; ++i) angle[i] = std::atan2(centre[i].y, centre[i].x);
  std::sort(angle.begin(), angle.end());
  const auto at = [&](std::size_t i) { return i < count ? angle[i] : angle[i - count] + two_pi; };
  for (std::size_t i = 0; i < count; ++i) {  // the quarter that begins between centres i and i + 1
    const double low = std::max(at(i), at(i + quarter) - 0.25 * two_pi);
    const double high = std::min(at(i + 1), at(i + quarter + 1) - 0.25 * two_pi);
    if (low < high) return 0.5 * (low + high);
  }
  throw Stop(ExitCode::guard, "charge: several centres at one angle leave no fair quarter; choose another run.seed");
}

/// The quarter x >= 0, y >= 0 of a packed body, turned so that its share is exact.
std::vector<Vec3> cut_quarter(const std::vector<Vec3>& ball) {
  const double angle = angle_of_fair_quarter(ball), c = std::cos(angle), s = std::sin(angle);
  std::vector<Vec3> quarter;
  for (const Vec3& x : ball) {
    const Vec3 turned{c * x.x + s * x.y, c * x.y - s * x.x, x.z};
    if (turned.x >= 0.0 && turned.y >= 0.0) quarter.push_back(turned);
  }
  return quarter;
}

}  // namespace

std::vector<Vec3> charge_positions(const ChargePositions& wanted) {
  if (!wanted.quarter) return packed_body(wanted, wanted.count);
  return cut_quarter(packed_body(wanted, 4 * wanted.count));
}

}  // namespace standoff::particles
