#include "particle_solver/step/air_boundaries.hpp"

#include <algorithm>
#include <limits>

#include "particle_solver/kernels/collision_pairs.hpp"

namespace standoff::particles {

void AirBoundaries::take_out_sleepers(Air& air, Boundaries& exits, BoundaryBooks& books) {
  out_.clear();
  for (std::size_t i = 0; i < air.particles.size(); ++i) {
    const AirCell here = air.cells.state_at(air.particles.position[i]);
    if (here == AirCell::asleep || here == AirCell::outside) out_.push_back(static_cast<std::uint32_t>(i));
  }
  exits.take_out(air.particles, out_, books);
}

namespace {

/// Awake air grows for ever; arrays that double would be half empty.
void make_room_for_one(GasState& gas) {
  if (gas.size() < gas.position.capacity()) return;
  const std::size_t room = gas.size() + gas.size() / 16 + 256;
  gas.position.reserve(room), gas.velocity.reserve(room), gas.internal_energy.reserve(room);
  gas.plate_rebound.reserve(room), gas.disturbed.reserve(room), gas.id.reserve(room);
}

}  // namespace

void AirBoundaries::add(Air& air, const Vec3& position, const Vec3& velocity, double internal, BoundaryBooks& books) {
  GasState& gas = air.particles;
  make_room_for_one(gas);
  gas.position.push_back(position), gas.velocity.push_back(velocity);
  if (air.ambient.zeta > 0.0) gas.internal_energy.push_back(internal);
  gas.plate_rebound.push_back(std::numeric_limits<double>::quiet_NaN());
  gas.disturbed.push_back(0);
  gas.id.push_back(air.next_id++);
  books.inflow_momentum += velocity * gas.mass;
  books.inflow_energy += 0.5 * gas.mass * squared_norm(velocity) + (air.ambient.zeta > 0.0 ? internal : 0.0);
}

void AirBoundaries::wake(Air& air, const GasState* products, const SandState* sand, BoundaryBooks& books) {
  for (std::size_t i = 0; i < air.particles.size(); ++i)
    if (air.particles.disturbed[i] != 0) air.cells.disturb(air.particles.position[i]);
  if (products != nullptr)
    for (std::size_t i = 0; i < products->size(); ++i)
      if (products->all_released() || products->released[i] != 0) air.cells.disturb(products->position[i]);
  if (sand != nullptr)
    for (std::size_t i = 0; i < sand->size(); ++i)
      if (squared_norm(sand->velocity[i]) > air.still_speed * air.still_speed) air.cells.disturb(sand->position[i]);

  const double expected = air.ambient.number_density() * air.cells.volume();
  const Vec3 width = air.cells.width();
  for (const std::uint32_t cell : air.cells.wake()) {
    CounterRandom random(options_.seed, RandomUse::air_fill, cell);
    const Vec3 low = air.cells.lower_corner(cell);
    for (long k = whole_with_mean(expected, random); k > 0; --k) {
      const Vec3 x = low + Vec3{width.x * random.uniform(), width.y * random.uniform(), width.z * random.uniform()};
      const Vec3 v = maxwell_velocity(air.ambient, random);
      const double internal = equilibrium_internal_energy(air.ambient, random);
      if (norm(x - air.body_centre) < air.body_radius || (air.sand && air.sand->beyond_outside(x) < 0.0)) continue;
      add(air, x, v, internal, books);
      air.woken += 1.0;
    }
  }
}

namespace {

/// A point of a source's face.
Vec3 point_of_face(const AirSource& source, const AirCells& cells, CounterRandom& random) {
  const Vec3 width = cells.width(), low = cells.lower_corner(source.cell);
  const double near = source.sign > 0.0 ? 0.0 : 1.0, a = random.uniform(), b = random.uniform();
  if (source.axis == 0) return low + Vec3{near * width.x, a * width.y, b * width.z};
  if (source.axis == 1) return low + Vec3{b * width.x, near * width.y, a * width.z};
  return low + Vec3{a * width.x, b * width.y, near * width.z};
}

}  // namespace

void AirBoundaries::let_in(Air& air, BoundaryBooks& books, double dt, std::uint32_t number) {
  const auto sources = air.cells.sources();
  if (sources.empty()) return;
  const Vec3 width = air.cells.width();
  const double area[3] = {width.y * width.z, width.z * width.x, width.x * width.y};
  const double largest = std::max({area[0], area[1], area[2]});
  CounterRandom random(options_.seed, RandomUse::air_inflow, number);
  // As many as all faces would send if each were the largest; a smaller one sends its share of them.
  const double expected = one_way_flux(air.ambient) * dt * largest * static_cast<double>(sources.size());
  for (long k = whole_with_mean(expected, random); k > 0; --k) {
    const AirSource& source = sources[pick(sources.size(), random)];
    if (random.uniform() * largest > area[source.axis]) continue;
    const Vec3 x = point_of_face(source, air.cells, random);
    const Vec3 v = crossing_velocity(air.ambient, source.axis, source.sign, random);
    const double internal = equilibrium_internal_energy(air.ambient, random), since = dt * random.uniform();
    const bool through_plate = source.axis == 2 && source.sign > 0.0 && x.z <= 0.0 && !air.cells.beside_cover(x);
    if (through_plate) continue;
    // Part of the step is flown already, unless the plate might have been in the way.
    const Vec3 flown = x + v * since, end = options_.sides.on() ? image_inside(options_.sides, flown) : flown;
    const AirCell there = air.cells.state_at(end);
    if (there == AirCell::asleep || there == AirCell::outside) continue;  // it has flown out again
    const bool clear = end.z > air.particles.radius || (air.cells.beside_cover(x) && air.cells.beside_cover(end));
    add(air, clear ? end : x, v, internal, books);
  }
}

double AirBoundaries::press_rear(const Air& air, SurfaceSheet& sheet, BoundaryBooks& books, double dt) const {
  const auto nodes = sheet.node_position();
  const auto plate = static_cast<std::int32_t>(sheet.plate_faces());
  double away = 0.0;
  for (std::int32_t face = 0; face < plate; ++face) {
    const auto& quad = sheet.mesh().quads[static_cast<std::size_t>(face)];
    const auto corner = [&](std::size_t k) { return nodes[static_cast<std::size_t>(quad[k])]; };
    const Vec3 middle = (corner(0) + corner(1) + corner(2) + corner(3)) * 0.25;
    if (!air.cells.awake_over_plate(middle.x, middle.y)) continue;
    const Vec3 area = cross(corner(2) - corner(0), corner(3) - corner(1)) * 0.5;
    SheetPoint where;
    where.face = face;
    const Impact impact = sheet.push(where, area * (air.ambient.pressure * dt), 0.0);
    books.inflow_momentum += impact.impulse;
    books.inflow_energy += impact.work;
    away -= impact.impulse.z;
  }
  return away;
}

double AirBoundaries::run(Air& air, const GasState* products, const SandState* sand, SurfaceSheet* sheet,
                          Boundaries& exits, BoundaryBooks& books, double dt, std::uint32_t number) {
  exits.run(&air.particles, nullptr, sheet, books);
  take_out_sleepers(air, exits, books);
  let_in(air, books, dt, number);
  wake(air, products, sand, books);
  return sheet != nullptr && options_.rear_pressure ? press_rear(air, *sheet, books, dt) : 0.0;
}

}  // namespace standoff::particles
