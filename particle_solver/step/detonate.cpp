#include "particle_solver/step/detonate.hpp"

#include <algorithm>
#include <tuple>

#include "coupling/base/stop.hpp"
#include "particle_solver/kernels/gas_release.hpp"
#include "particle_solver/search/gas_cell_grid.hpp"

namespace standoff::particles {
namespace {

using Indices = std::vector<std::uint32_t>;

// The first shell of neighbours in a charge of fill 0.2 is 2.8 radii away, at fill 0.05 4.4 radii.
constexpr double near_in_radii = 6.0, farthest_in_radii = 24.0;
// A group of products gives at most half of its thermal energy to the last impulses.
constexpr double least_thermal_share = 0.5;

/// Who is near whom. Nobody moves during the stage, so one sort serves it; it is made when it is first asked for.
class Neighbours {
 public:
  Neighbours(const GasState& gas, GasCellGrid& grid) : gas_(gas), grid_(grid) {}

  /// Others within `reach` of particle i that wait, or that do not, in the order of the cells.
  Indices near(std::uint32_t i, double reach, bool waiting) {
    if (!sorted_) {
      sorted_ = true;
      grid_.shape(gas_.size(), near_in_radii * gas_.radius);
      grid_.sort(gas_.position);
    }
    Indices found;
    grid_.visit<false>(gas_.position[i], reach, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t p = begin; p < end; ++p) {
        const std::uint32_t k = grid_.order()[p];
        const bool inside = squared_norm(gas_.position[k] - gas_.position[i]) <= reach * reach;
        if (inside && k != i && (gas_.released[k] == 0) == waiting) found.push_back(k);
      }
    });
    return found;
  }

 private:
  const GasState& gas_;
  GasCellGrid& grid_;
  bool sorted_ = false;
};

/// Gives the impulse `rest` to released particles; false if they cannot pay for it.
bool give_to_released(GasState& gas, const Indices& group, const Vec3& rest) {
  if (group.empty()) return false;
  const double mass = gas.mass * static_cast<double>(group.size());
  Vec3 mean;
  for (const auto k : group) mean += gas.velocity[k] / static_cast<double>(group.size());
  double thermal = 0.0;
  for (const auto k : group) thermal += 0.5 * gas.mass * squared_norm(gas.velocity[k] - mean) + gas.internal_energy[k];
  const double left = thermal_share_left(mass, mean, rest, thermal);
  if (left < least_thermal_share) return false;
  for (const auto k : group) {
    gas.velocity[k] = mean + rest / mass + (gas.velocity[k] - mean) * std::sqrt(left);
    gas.internal_energy[k] *= left;
  }
  return true;
}

void hand_on(GasState& gas, Neighbours& neighbours, std::uint32_t i, const Vec3& rest) {
  for (double reach = near_in_radii; reach <= farthest_in_radii; reach *= 2.0) {
    const Indices waiting = neighbours.near(i, reach * gas.radius, true);
    for (const auto k : waiting) gas.latent_impulse.add(gas.id[k], rest / static_cast<double>(waiting.size()));
    if (!waiting.empty()) return;
  }
  for (double reach = near_in_radii;; reach *= 2.0) {
    Indices group = neighbours.near(i, reach * gas.radius, false);
    group.push_back(i);
    if (give_to_released(gas, group, rest)) return;
    if (group.size() >= gas.size())
      throw Stop(ExitCode::guard,
                 "detonate: the products cannot carry the impulse that the waiting explosive took; the charge has too "
                 "little energy for its detonation speed, or too few particles: raise charge.particles");
  }
}

void let_go(GasState& gas, Neighbours& neighbours, std::uint32_t i) {
  const Release loose = release(gas.mass, gas.velocity[i], gas.internal_energy[i], gas.latent_impulse.of(gas.id[i]));
  gas.velocity[i] = loose.velocity;
  gas.internal_energy[i] = loose.internal_energy;
  gas.latent_impulse.forget(gas.id[i]);
  gas.released[i] = 1;
  if (squared_norm(loose.handed_on) > 0.0) hand_on(gas, neighbours, i, loose.handed_on);
}

}  // namespace

long detonate(GasState& gas, double time, GasCellGrid* idle) {
  if (gas.all_released()) return 0;
  Indices due;
  for (std::uint32_t i = 0; i < gas.size(); ++i)
    if (gas.released[i] == 0 && gas.release_time[i] <= time) due.push_back(i);
  // In the order of the front: what one hands on reaches those behind which the front has yet to pass.
  std::sort(due.begin(), due.end(), [&](auto i, auto k) {
    return std::tuple{gas.release_time[i], gas.id[i]} < std::tuple{gas.release_time[k], gas.id[k]};
  });
  GasCellGrid own;
  Neighbours neighbours(gas, idle != nullptr ? *idle : own);
  for (const auto i : due) let_go(gas, neighbours, i);
  if (std::all_of(gas.released.begin(), gas.released.end(), [](auto flag) { return flag != 0; })) {
    gas.released = std::vector<std::uint8_t>();  // `= {}` would keep the memory
    gas.release_time = std::vector<double>();
  }
  return static_cast<long>(due.size());
}

GasTotals gas_totals(const GasState& gas) {
  GasTotals totals;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    const double kinetic = 0.5 * gas.mass * squared_norm(gas.velocity[i]);
    totals.momentum += gas.velocity[i] * gas.mass;
    if (gas.all_released() || gas.released[i] != 0) {
      totals.kinetic += kinetic;
      totals.internal += gas.internal_energy[i];
    } else {
      totals.momentum += gas.latent_impulse.of(gas.id[i]);
      totals.waiting += kinetic + gas.internal_energy[i];
    }
  }
  return totals;
}

}  // namespace standoff::particles
