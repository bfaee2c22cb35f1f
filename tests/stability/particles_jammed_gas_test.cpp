// Products jammed at a fill of 0.6, far above where hard spheres freeze (0.494), in the corner of a rigid box: two
// mirror planes and a floor of infinite mass. Law: elastic hits with reservoirs keep energy and momentum; nothing
// leaves through a wall. Tolerance: rounding, a few 1e-16 of the energy for each of some 1e5 hits. The danger is
// Zeno's: chains of hits without end within one step, cut off by a limit; none may be left undone in silence.
#include <gtest/gtest.h>

#include "tests/unit/particles_gas_scenes.hpp"

namespace standoff::particles {
namespace {

TEST(JammedProducts, AtFillSixTenthsInARigidBox_KeepEnergyMomentumAndWalls) {
  GasState gas = test::lattice_gas(6, 0.6, 1.4, 2.0 / 3.0);
  GasCollideOptions options;
  options.walls = {true, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
  GasCollide collide(options);
  const GasTotals start = gas_totals(gas);
  Vec3 mirrors;
  long hits = 0, deferred = 0;
  double inside = 1.0;
  test::run_gas(collide, gas, nullptr, nullptr, 400, 1.0, [&](const GasCollideCounts& counts, double) {
    mirrors += counts.mirror_impulse, hits += counts.hits(), deferred += counts.deferred;
    for (const Vec3& x : gas.position) inside = std::min({inside, x.x, x.y, x.z, 1.0 - x.x, 1.0 - x.y, 1.0 - x.z});
  });
  const GasTotals end = gas_totals(gas);
  EXPECT_GT(hits, 20000);
  EXPECT_NEAR(end.kinetic + end.internal, start.kinetic + start.internal, 1e-12 * start.kinetic);
  EXPECT_LT(norm(end.momentum + mirrors - start.momentum), 1e-12 * test::momentum_scale(gas));
  EXPECT_GE(inside, -1e-15) << "m: a centre beyond a wall, farther than rounding";
  EXPECT_EQ(deferred, 0) << "hits left undone of " << hits;
}

}  // namespace
}  // namespace standoff::particles
