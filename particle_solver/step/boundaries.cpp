#include "particle_solver/step/boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "particle_solver/step/grain_rotation.hpp"

namespace standoff::particles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Drops the elements named by `out` (ascending) and keeps the order of the rest. Absent arrays stay absent.
template <class T>
void drop(std::vector<T>& values, const std::vector<std::uint32_t>& out) {
  if (values.empty()) return;
  std::size_t write = out.front(), next = 0;
  for (std::size_t read = write; read < values.size(); ++read) {
    if (next < out.size() && read == out[next])
      ++next;
    else
      values[write++] = values[read];
  }
  values.resize(write);
}

/// kg m/s after the last contact with the plate, 0 before the first.
double rebound(const std::vector<double>& last, std::uint32_t i) {
  return last.empty() || std::isnan(last[i]) ? 0.0 : last[i];
}

double radius_of(const GasState& gas, std::size_t) {
  return gas.radius;
}
double radius_of(const SandState& sand, std::size_t i) {
  return sand.radius_of(i);
}
bool waits(const GasState& gas, std::size_t i) {
  return !gas.released.empty() && gas.released[i] == 0;  // stands still inside the charge
}
bool waits(const SandState&, std::size_t) {
  return false;
}

}  // namespace

Boundaries::Boundaries(const BoundaryOptions& options)
    : options_(options),
      found_(static_cast<std::size_t>(std::max(1, options.threads))),
      slips_(static_cast<std::size_t>(std::max(1, options.threads))) {}

Boundaries::Limits Boundaries::limits(const SurfaceSheet* sheet) const {
  Limits limits{options_.lower, options_.upper, infinity, infinity, -infinity, -infinity};
  if (options_.closed) limits.lower = {-infinity, -infinity, -infinity}, limits.upper = {infinity, infinity, infinity};
  if (options_.quarter || options_.repeats) limits.lower.x = limits.lower.y = -infinity;
  if (options_.repeats) limits.upper.x = limits.upper.y = infinity;
  if (sheet == nullptr || !sheet->is_level()) return limits;  // a pipe has no rear that gas could get behind
  const std::vector<Vec3>& rest = sheet->mesh().position;
  limits.outline_x = limits.outline_y = 0.0;
  for (const Vec3& x : rest) {
    limits.outline_x = std::max(limits.outline_x, std::abs(x.x));
    limits.outline_y = std::max(limits.outline_y, std::abs(x.y));
  }
  const double inner = 1.0 - 1e-9;
  for (const Vec3& x : rest)
    if (std::abs(x.x) >= inner * limits.outline_x || std::abs(x.y) >= inner * limits.outline_y)
      limits.edge_height = std::max(limits.edge_height, x.z);
  limits.lowest = sheet->lowest(0.0);
  return limits;
}

template <class State>
void Boundaries::find(const State& state, const Limits& limits, std::vector<std::uint32_t>& out) {
  const auto size = static_cast<std::ptrdiff_t>(state.size());
  const auto parts = static_cast<std::ptrdiff_t>(found_.size());
#pragma omp parallel for schedule(static) num_threads(static_cast <int>(parts)) if (parts > 1)
  for (std::ptrdiff_t part = 0; part < parts; ++part) {
    auto &found = found_[static_cast<std::size_t>(part)], &slips = slips_[static_cast<std::size_t>(part)];
    found.clear(), slips.clear();
    for (std::ptrdiff_t k = size * part / parts; k < size * (part + 1) / parts; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vec3& x = state.position[i];
      const bool inside = x.x >= limits.lower.x && x.x <= limits.upper.x && x.y >= limits.lower.y &&
                          x.y <= limits.upper.y && x.z >= limits.lower.z && x.z <= limits.upper.z;
      if (inside && x.z >= limits.edge_height) continue;
      const double below = x.z + radius_of(state, i);
      const bool beside = std::abs(x.x) > limits.outline_x || std::abs(x.y) > limits.outline_y;
      const bool slipped = inside && !beside && below < limits.lowest;
      if ((inside && !slipped && !(beside && below < limits.edge_height)) || waits(state, i)) continue;
      found.push_back(static_cast<std::uint32_t>(i));
      if (slipped) slips.push_back(static_cast<std::uint32_t>(i));
    }
  }
  out.clear();
  for (std::size_t part = 0; part < found_.size(); ++part) {
    out.insert(out.end(), found_[part].begin(), found_[part].end());
    totals_.slipped += static_cast<long>(slips_[part].size());
    if (!slips_[part].empty()) totals_.last_slip = state.position[slips_[part].back()];
  }
}

void Boundaries::take_out(GasState& gas, const std::vector<std::uint32_t>& out, BoundaryBooks& books) {
  if (out.empty()) return;
  for (const std::uint32_t i : out) {
    const Vec3& v = gas.velocity[i];
    books.escaped_momentum += v * gas.mass;
    books.escaped_energy += 0.5 * gas.mass * squared_norm(v);
    if (!gas.internal_energy.empty()) books.escaped_energy += gas.internal_energy[i];
    totals_.gas_rebound += rebound(gas.plate_rebound, i);
  }
  totals_.gas += static_cast<long>(out.size());
  drop(gas.position, out), drop(gas.velocity, out), drop(gas.internal_energy, out);
  drop(gas.release_time, out), drop(gas.released, out);
  drop(gas.plate_rebound, out), drop(gas.disturbed, out), drop(gas.id, out);
}

/// Grains that fly out through a wall of the box; returns the impulse on the walls, N s.
Vec3 Boundaries::turn_round(SandState& sand) const {
  Vec3 impulse;
  const Vec3 &low = options_.lower, &high = options_.upper;
  const auto outwards = [](double x, double v, double from, double to) {
    return (x < from && v < 0.0) || (x > to && v > 0.0);
  };
  for (std::size_t i = 0; i < sand.size(); ++i) {
    const Vec3 x = sand.position[i], before = sand.velocity[i];
    Vec3& v = sand.velocity[i];
    if (!options_.quarter || x.x > 0.0) v.x *= outwards(x.x, v.x, low.x, high.x) ? -1.0 : 1.0;
    if (!options_.quarter || x.y > 0.0) v.y *= outwards(x.y, v.y, low.y, high.y) ? -1.0 : 1.0;
    v.z *= outwards(x.z, v.z, low.z, high.z) ? -1.0 : 1.0;
    impulse += (before - v) * sand.mass_of(i);
  }
  return impulse;
}

void Boundaries::take_out(SandState& sand, const std::vector<std::uint32_t>& out, BoundaryBooks& books) {
  if (out.empty()) return;
  for (const std::uint32_t i : out) {
    const double mass = sand.mass_of(i);
    books.escaped_momentum += sand.velocity[i] * mass;
    double energy = 0.5 * mass * squared_norm(sand.velocity[i]);
    if (!sand.spin.empty()) energy += rotation_energy(sand, i);
    books.escaped_energy += energy, totals_.sand_energy += energy;
    totals_.sand_mass += mass;
    totals_.sand_rebound += rebound(sand.plate_rebound, i);
  }
  totals_.sand += static_cast<long>(out.size());
  drop(sand.grain_radius, out), drop(sand.grain_mass, out), drop(sand.position, out), drop(sand.velocity, out);
  drop(sand.force, out), drop(sand.spin, out), drop(sand.torque, out), drop(sand.plate_rebound, out),
      drop(sand.id, out);
}

const BoundaryChanges& Boundaries::run(GasState* gas, SandState* sand, const SurfaceSheet* sheet,
                                       BoundaryBooks& books) {
  const Limits now = limits(sheet);
  changes_.gas.clear(), changes_.sand.clear();
  if (options_.closed && sand != nullptr) books.mirror_impulse += turn_round(*sand);
  if (gas != nullptr) find(*gas, now, changes_.gas);
  if (sand != nullptr) find(*sand, now, changes_.sand);
  const double before = books.escaped_energy;
  if (gas != nullptr) take_out(*gas, changes_.gas, books);
  if (gas != nullptr && gas->disturbed.empty()) totals_.gas_energy += books.escaped_energy - before;  // not air
  if (sand != nullptr) take_out(*sand, changes_.sand, books);
  return changes_;
}

}  // namespace standoff::particles
