// Law: gas that hits the sheet gives it exactly the momentum and the energy it loses (elastic, finite wall mass),
// however many hits fall into one window; nothing gets behind it. Tolerance 1e-12 of the sum of |impulses| and of the
// energy.
#include <gtest/gtest.h>

#include "tests/unit/particles_gas_scenes.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

double sheet_energy(const SurfaceSheet& sheet, double node_mass) {
  double energy = 0.0;
  for (const Vec3& v : sheet.node_velocity()) energy += 0.5 * node_mass * squared_norm(v);
  return energy;
}

TEST(GasOnAFreeSheet_ManyHitsInOneWindow_ConserveMomentumAndEnergy, AndNothingPasses) {
  const double node_mass = 0.2;  // 16 kg of sheet against 1 kg of gas: it gives way, but keeps its shape for a while
  const SurfaceMesh mesh = test::flat_mesh(8, 2.0, node_mass);
  SurfaceSheet sheet(mesh, {});
  sheet.begin_window(test::at_rest(mesh), false);
  GasState gas = test::lattice_gas(6, 0.10, 1.4, 2.0 / 3.0);
  for (Vec3& x : gas.position) x += Vec3{-0.5, -0.5, 0.1};
  for (Vec3& v : gas.velocity) v.z -= 4.0;
  const Vec3 momentum = gas_totals(gas).momentum;
  const double energy = gas_totals(gas).energy();
  GasCollide collide({});
  GasCollideCounts sum;
  test::run_gas(collide, gas, nullptr, &sheet, 80, 0.01, [&](const GasCollideCounts& counts, double) {
    sum.sheet_hits += counts.sheet_hits;
    sum.plate_impulse += counts.plate_impulse, sum.plate_incoming += counts.plate_incoming;
  });
  EXPECT_GT(sum.sheet_hits, 500);
  const GasTotals after = gas_totals(gas);
  const double scale = test::momentum_scale(gas);
  EXPECT_LT(norm(after.momentum + sheet.total_impulse() - momentum), 1e-12 * scale);
  EXPECT_NEAR(after.energy() + sheet_energy(sheet, node_mass), energy, 1e-12 * energy);
  EXPECT_NEAR(sum.plate_impulse, -sheet.total_impulse().z, 1e-12 * scale) << "positive away from the charge";
  double rebound = 0.0;
  long touched = 0;
  for (std::size_t i = 0; i < gas.size(); ++i) {
    if (std::isnan(gas.plate_rebound[i])) continue;
    rebound += gas.plate_rebound[i], ++touched;
    EXPECT_GE(sheet.closest(gas.position[i], 10.0).gap, 0.5 * gas.radius) << "particle " << gas.id[i];
  }
  EXPECT_GT(touched, 300);
  EXPECT_GT(sum.plate_incoming, 0.0);
}

TEST(GasOnTheRigidSurround_IsNoPlateLoad, BooksStayEmpty) {
  const SurfaceMesh mesh = test::flat_mesh(2, 0.1, 1.0);
  SheetOptions options;
  options.surround_half_size = 3.0;
  SurfaceSheet sheet(mesh, options);
  sheet.begin_window(test::at_rest(mesh), false);
  GasState gas = test::lattice_gas(3, 0.02, 5.0 / 3.0, 0.0);
  for (Vec3& x : gas.position) x += Vec3{1.0, 1.0, 0.1};  // beside the plate
  for (Vec3& v : gas.velocity) v = {0.0, 0.0, -1.0};
  const double energy = gas_totals(gas).energy();
  GasCollide collide({});
  GasCollideCounts sum;
  test::run_gas(collide, gas, nullptr, &sheet, 200, 0.05, [&](const GasCollideCounts& counts, double) {
    sum.sheet_hits += counts.sheet_hits;
    sum.plate_impulse += counts.plate_impulse, sum.plate_incoming += counts.plate_incoming;
  });
  EXPECT_GE(sum.sheet_hits, 108);
  EXPECT_EQ(sum.plate_impulse, 0.0);
  EXPECT_EQ(sum.plate_incoming, 0.0);
  EXPECT_NEAR(gas_totals(gas).energy(), energy, 1e-12 * energy);
  EXPECT_NEAR(-sheet.surround_impulse().z, gas_totals(gas).momentum.z + 1.0, 1e-12);
}

}  // namespace
}  // namespace standoff::particles
