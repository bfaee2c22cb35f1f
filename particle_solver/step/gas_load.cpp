// Into cell order at the start of a sub-step, and now and then the state itself.
#include <algorithm>
#include <cstring>
#include <type_traits>

#include "particle_solver/step/gas_work.hpp"

namespace standoff::particles::gas {
namespace {

// Below this many items a parallel region costs more than it saves; the result does not depend on it.
constexpr std::size_t worth_threads = 2000;

/// Where the grid believes a gas particle to be.
struct MiddleOfGas {
  const GasState& gas;
  double h;
  bool moves(std::size_t i) const { return gas.all_released() || gas.released[i] != 0; }
  Vec3 operator()(std::size_t i) const {
    return moves(i) ? gas.position[i] + gas.velocity[i] * (0.5 * h) : gas.position[i];
  }
};

void load_bodies(Work& work, const MiddleOfGas& middle) {
  const GasState& gas = *work.gas;
  const std::size_t count = gas.size();
  work.lanes.resize(count);
  double fastest = 0.0, square_sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 velocity = middle.moves(i) ? gas.velocity[i] : Vec3{};
    const double square = squared_norm(velocity);
    fastest = std::max(fastest, square);
    square_sum += square;
    work.lanes.measure(gas.position[i], velocity * work.h);
  }
  work.excursion = 0.5 * work.h * std::sqrt(fastest);
  const double usual = 0.5 * work.h * std::sqrt(square_sum / static_cast<double>(std::max<std::size_t>(count, 1)));
  work.grid.shape(count, 2.0 * work.radius + work.excursion + usual, work.periodic.period);
  work.grid.sort(count, middle, work.choice.scratch(count));

  work.since.assign(count, 0.0);
  const auto order = work.grid.order();
#pragma omp parallel for num_threads(work.threads) schedule(static) if (count > worth_threads)
  for (std::size_t p = 0; p < count; ++p) {
    const Index i = order[p];
    work.lanes.set(p, gas.position[i], middle.moves(i) ? gas.velocity[i] * work.h : Vec3{});
  }
}

template <bool Periodic>
void load_grains(Work& work, const MiddleOfGas& middle_of_gas) {
  const SandState& sand = *work.sand;
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
  work.near_map.mark(work.count(), middle_of_gas, reach, work.periodic.period);
  const auto middle = [&](std::size_t i) { return sand.position[i] + sand.velocity[i] * (0.5 * work.h); };
  std::vector<Index> near;
  for (std::size_t i = 0; i < sand.size(); ++i)
    if (work.near_map.near<Periodic>(middle(i))) near.push_back(static_cast<Index>(i));

  const std::size_t count = near.size();
  work.grain_grid.shape(count, contact + work.excursion_grain + work.excursion, work.periodic.period);
  std::vector<Index> scratch(count);
  work.grain_grid.sort(
      count, [&](std::size_t k) { return middle(near[k]); }, scratch);
  work.grain.assign(count, {});
  work.grain_lanes.resize(count);
  work.grain_lanes.contact.assign(count + Lanes::pad, 0.0f);
  for (std::size_t q = 0; q < count; ++q) {
    const Index i = near[work.grain_grid.order()[q]];
    const Vec3 path = sand.velocity[i] * work.h;
    work.grain[q].source = i;
    work.grain_lanes.set(q, sand.position[i], path);
    work.grain_lanes.measure(sand.position[i], path);
    work.grain_lanes.contact[q] = static_cast<float>(work.radius + sand.radius_of(i));
  }
}

/// Puts numbers in cell order; `number(i)` is one of the i-th particle, and `room` holds as many.
template <class Number>
void permute(Number&& number, std::span<const Index> order, std::span<double> room) {
  using T = std::remove_reference_t<decltype(number(Index{}))>;
  static_assert(sizeof(T) <= sizeof(double));
  for (std::size_t p = 0; p < order.size(); ++p) std::memcpy(&room[p], &number(order[p]), sizeof(T));
  for (std::size_t p = 0; p < order.size(); ++p) std::memcpy(&number(static_cast<Index>(p)), &room[p], sizeof(T));
}
template <class T>
void permute(std::vector<T>& values, std::span<const Index> order, std::span<double> room) {
  if (!values.empty()) permute([&](Index i) -> T& { return values[i]; }, order, room);
}
void permute(std::vector<Vec3>& values, std::span<const Index> order, std::span<double> room) {
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z})
    permute([&](Index i) -> double& { return values[i].*axis; }, order, room);
}

}  // namespace

void load(Work& work) {
  const std::size_t count = work.gas->size();
  const MiddleOfGas middle{*work.gas, work.h};
  work.radius = work.gas->radius, work.mass = work.gas->mass;
  load_bodies(work, middle);
  work.grain.clear();
  if (work.sand != nullptr && work.sand->size() > 0)
    work.periodic.on() ? load_grains<true>(work, middle) : load_grains<false>(work, middle);

  work.choice.reset(count);
  work.mark.reset(count);
  work.moved.assign(count, 0.0f);
  work.waiting.clear(), work.visit.clear(), work.offered.clear();
  work.touched_grains.clear(), work.stale.clear();
}

void sort_state(Work& work) {
  GasState& gas = *work.gas;
  const auto order = work.grid.order();
  const auto room = work.choice.room();
  permute(gas.position, order, room);
  permute(gas.velocity, order, room);
  permute(gas.internal_energy, order, room);
  permute(gas.release_time, order, room);
  permute(gas.released, order, room);
  permute(gas.plate_rebound, order, room);
  permute(gas.id, order, room);
}

}  // namespace standoff::particles::gas
