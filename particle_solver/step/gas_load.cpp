// Into cell order at the start of a sub-step, and back at its end.
#include <algorithm>

#include "particle_solver/step/gas_work.hpp"

namespace standoff::particles::gas {
namespace {

// Below this many items a parallel region costs more than it saves; the result does not depend on it.
constexpr std::size_t worth_threads = 2000;

void load_bodies(Work& work, const GasState& gas) {
  const std::size_t count = gas.size();
  work.middle.resize(count);
  double fastest = 0.0, square_sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool moves = gas.all_released() || gas.released[i] != 0;
    work.middle[i] = moves ? gas.position[i] + gas.velocity[i] * (0.5 * work.h) : gas.position[i];
    const double square = moves ? squared_norm(gas.velocity[i]) : 0.0;
    fastest = std::max(fastest, square);
    square_sum += square;
  }
  work.excursion = 0.5 * work.h * std::sqrt(fastest);
  const double usual = 0.5 * work.h * std::sqrt(square_sum / static_cast<double>(std::max<std::size_t>(count, 1)));
  work.grid.shape(count, 2.0 * work.radius + work.excursion + usual, work.periodic_side);
  work.grid.sort(work.middle);

  work.body.resize(count);
  work.lanes.resize(count);
  work.binned.resize(count);
  work.unreleased.resize(gas.all_released() ? 0 : count);
  const auto order = work.grid.order();
#pragma omp parallel for num_threads(work.threads) schedule(static) if (count > worth_threads)
  for (std::size_t p = 0; p < count; ++p) {
    const Index i = order[p];
    const bool waits = !gas.all_released() && gas.released[i] == 0;
    work.body[p] = {gas.position[i], 0.0, waits ? Vec3{} : gas.velocity[i], i, gas.id[i]};
    work.lanes.set(p, work.body[p].start, work.body[p].velocity, 0.0);
    work.binned[p] = work.middle[i];
    if (!work.unreleased.empty()) work.unreleased[p] = waits ? 1 : 0;
  }
}

void load_grains(Work& work, const SandState& sand) {
  double fastest = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < sand.size(); ++i) {
    fastest = std::max(fastest, squared_norm(sand.velocity[i]));
    largest = std::max(largest, sand.radius_of(i));
  }
  work.excursion_grain = 0.5 * work.h * std::sqrt(fastest);
  work.largest_grain = largest;
  const double contact = work.radius + largest;
  // The middles of the paths of a grain and a body that meet are no farther apart than this; the factor leaves room for
  // bodies that turn towards another grain within the sub-step.
  const double reach = contact + work.excursion_grain + 2.0 * work.excursion;
  work.near_map.mark(work.middle, reach);
  work.near_grain.clear();
  for (std::size_t i = 0; i < sand.size(); ++i)
    if (work.near_map.near(sand.position[i] + sand.velocity[i] * (0.5 * work.h)))
      work.near_grain.push_back(static_cast<Index>(i));

  const std::size_t count = work.near_grain.size();
  work.middle.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Index i = work.near_grain[k];
    work.middle[k] = sand.position[i] + sand.velocity[i] * (0.5 * work.h);
  }
  work.grain_grid.shape(count, contact + work.excursion_grain + work.excursion);
  work.grain_grid.sort(work.middle);
  work.grain.resize(count);
  work.grain_lanes.resize(count);
  work.grain_lanes.contact.assign(count + Lanes::pad, 0.0);
  for (std::size_t q = 0; q < count; ++q) {
    const Index k = work.grain_grid.order()[q], i = work.near_grain[k];
    Grain& grain = work.grain[q];
    grain = {};
    grain.start = sand.position[i], grain.velocity = sand.velocity[i], grain.binned = work.middle[k];
    grain.radius = sand.radius_of(i), grain.inverse_mass = 1.0 / sand.mass_of(i), grain.source = i;
    work.grain_lanes.set(q, grain.start, grain.velocity, 0.0);
    work.grain_lanes.contact[q] = work.radius + grain.radius;
  }
}

template <class T>
void permute(std::vector<T>& values, std::span<const std::uint32_t> order) {
  if (values.empty()) return;
  std::vector<T> sorted(values.size());
  for (std::size_t p = 0; p < order.size(); ++p) sorted[p] = values[order[p]];
  values.swap(sorted);
}

}  // namespace

void load(Work& work, const GasState& gas, const SandState* sand) {
  const std::size_t count = gas.size();
  work.radius = gas.radius, work.mass = gas.mass;
  load_bodies(work, gas);
  work.grain.clear();
  if (sand != nullptr && sand->size() > 0) load_grains(work, *sand);

  work.choice.assign(count, {});
  work.touched_in.assign(count, 0);
  work.taken_in.assign(count, 0);
  work.pending.assign(count, 0);
  work.waiting.clear();
  work.visit.clear();
  work.touched_grains.clear();
  for (std::size_t p = 0; p < count; ++p)
    if (!work.is_unreleased(static_cast<Index>(p))) work.visit.push_back(static_cast<Index>(p));
}

void store(const Work& work, GasState& gas, SandState* sand, bool sort_state) {
  for (const Body& body : work.body) {
    if (body.since == 0.0 && work.touched_in[static_cast<std::size_t>(&body - work.body.data())] == 0) continue;
    gas.position[body.source] = body.start;
    gas.velocity[body.source] = body.velocity;
  }
  for (const Grain& grain : work.grain) {
    if (grain.touched_in == 0) continue;
    sand->position[grain.source] = grain.start;
    sand->velocity[grain.source] = grain.velocity;
  }
  if (!sort_state) return;
  const auto order = work.grid.order();
  permute(gas.position, order);
  permute(gas.velocity, order);
  permute(gas.internal_energy, order);
  permute(gas.release_time, order);
  permute(gas.released, order);
  permute(gas.latent_impulse, order);
  permute(gas.plate_rebound, order);
  permute(gas.id, order);
}

}  // namespace standoff::particles::gas
