// Law: what leaves is booked: momentum, energy, mass and count inside plus outside stay what they were; the rest keep
// their order. Tolerance: sums of 1000 terms, 1e-13 of their size.
#include <limits>

#include <gtest/gtest.h>

#include "particle_solver/step/boundaries.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

using namespace test;

GasState random_gas(int n) {
  CounterRandom random(9, RandomUse::test, 1);
  GasState gas;
  gas.mass = 1e-6, gas.radius = 1e-3;
  for (int i = 0; i < n; ++i) {
    gas.position.push_back(random_vector(random, 0.6)), gas.velocity.push_back(random_vector(random, 3000.0));
    gas.internal_energy.push_back(between(random, 0.0, 5.0)), gas.id.push_back(static_cast<std::uint32_t>(i));
    gas.plate_rebound.push_back(i % 3 ? std::numeric_limits<double>::quiet_NaN() : 1e-3 * i);
  }
  return gas;
}

struct Sums {
  double mass = 0.0, energy = 0.0, rebound = 0.0;
  Vec3 momentum;
};
Sums sums(const GasState& gas) {
  Sums s;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    s.mass += gas.mass, s.momentum += gas.velocity[i] * gas.mass;
    s.energy += 0.5 * gas.mass * squared_norm(gas.velocity[i]) + gas.internal_energy[i];
    if (gas.plate_rebound[i] == gas.plate_rebound[i]) s.rebound += gas.plate_rebound[i];
  }
  return s;
}

TEST(Boundaries_AroundAGas, BookAllThatLeaves) {
  const SurfaceSheet sheet(flat_mesh(4, 0.2, 1.0), {false, 0.3});
  for (const int threads : {1, 3}) {
    GasState gas = random_gas(1000);
    const Sums before = sums(gas);
    Boundaries boundaries({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, false, threads});
    BoundaryBooks books;
    const BoundaryChanges out = boundaries.run(&gas, nullptr, &sheet, books);
    const Sums after = sums(gas);
    EXPECT_GT(out.gas.size(), 100u);
    EXPECT_EQ(gas.size() + out.gas.size(), 1000u);
    EXPECT_EQ(gas.velocity.size(), gas.size());
    EXPECT_TRUE(std::is_sorted(gas.id.begin(), gas.id.end())) << "order kept";
    EXPECT_TRUE(std::is_sorted(out.gas.begin(), out.gas.end()));
    EXPECT_EQ(boundaries.totals().gas, static_cast<long>(out.gas.size()));
    EXPECT_LT(norm(after.momentum + books.escaped_momentum - before.momentum), 1e-13) << "kg m/s of 3";
    EXPECT_NEAR(after.energy + books.escaped_energy, before.energy, 1e-13 * before.energy);
    EXPECT_NEAR(after.rebound + boundaries.totals().gas_rebound, before.rebound, 1e-12 * before.rebound);
    EXPECT_FALSE(boundaries.run(&gas, nullptr, &sheet, books).any()) << "nothing more to take";
  }
}

TEST(Boundaries_BehindThePlate, TakeWhatPassedBesideIt) {
  SurfaceMesh mesh = flat_mesh(4, 0.2, 1.0);
  SurfaceSheet sheet(mesh, {});
  SurfaceMotion motion = at_rest(mesh);
  motion.position[12].z = -0.05;  // dished
  sheet.begin_window(motion, false);
  SandState sand;
  sand.radius = 1e-3, sand.mass = 1e-4;
  sand.position = {{0.21, 0, -0.0009}, {0.21, 0, -0.0011}, {0, 0, -0.04},
                   {0, 0, -0.0509},    {0, 0.1, -0.0511},  {0, 0, 0.6}};
  sand.velocity.assign(6, {0, 0, -10}), sand.force.assign(6, {}), sand.id = {0, 1, 2, 3, 4, 5};
  sand.plate_rebound.assign(6, 1e-3);
  Boundaries boundaries({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, false, 1});
  BoundaryBooks books;
  const BoundaryChanges out = boundaries.run(nullptr, &sand, &sheet, books);
  EXPECT_EQ(out.sand, (std::vector<std::uint32_t>{1, 4, 5}));
  EXPECT_EQ(sand.id, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(boundaries.totals().slipped, 1) << "the one below the dish";
  EXPECT_NEAR(boundaries.totals().sand_mass, 3e-4, 1e-18);
  EXPECT_NEAR(books.escaped_momentum.z, -3e-3, 1e-17);
}

TEST(Boundaries_OfAQuarter, HaveNoExitAtTheMirrors) {
  GasState gas = random_gas(3);
  gas.position = {{-1e-9, 0.1, 0.1}, {0.1, -1e-9, 0.1}, {0.51, 0.1, 0.1}};
  gas.released = {1, 1, 1};
  Boundaries boundaries({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, true, 1});
  BoundaryBooks books;
  EXPECT_EQ(boundaries.run(&gas, nullptr, nullptr, books).gas, (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(gas.released.size(), 2u);
  EXPECT_TRUE(gas.release_time.empty()) << "absent arrays stay absent";
}

}  // namespace
}  // namespace standoff::particles
