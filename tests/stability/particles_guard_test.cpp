// Guards of the particle process. A plate that an exchange moves past the particles leaves them behind it with all they
// have: energy and momentum books close to rounding, no impulse was given, and only counting finds it. Law: nothing
// passes through a plate; the limit is one particle in a thousand. Energy: 5 % of what there was; NaN is beyond it.
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/base/stop.hpp"
#include "particle_solver/app/particle_guard.hpp"
#include "tests/unit/particles_gas_scenes.hpp"
#include "tests/unit/particles_surface_builders.hpp"

namespace standoff::particles {
namespace {

std::string said(const std::function<void()>& guard) {
  try {
    guard();
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), ExitCode::guard);
    return stop.what();
  }
  return "";
}

/// A gas from 1.2 to 0.2 m below the edge of a plate, which the next exchange has at height `z`.
struct Jump {
  GasState gas = test::lattice_gas(3, 0.1, 1.4, 2.0 / 3.0);
  long particles = static_cast<long>(gas.size());
  SurfaceSheet sheet{test::flat_mesh(4, 1.5, 1.0), {}};
  Boundaries boundaries{{{-2, -2, -2}, {2, 2, 2}, false, 1}};
  BoundaryBooks books;
  GasTotals before = gas_totals(gas);

  CarriedGas carried;

  explicit Jump(double z, bool carry = false) {
    for (Vec3& x : gas.position) x.z -= 1.2;
    for (const double height : {-1.3, z}) {  // below them, then where the exchange has it
      SurfaceMotion motion = test::at_rest(test::flat_mesh(4, 1.5, 1.0));
      for (Vec3& x : motion.position) x.z = height;
      sheet.begin_window(motion, false);
    }
    if (carry) surface_carry(gas, sheet, 2, carried);
    boundaries.run(&gas, nullptr, &sheet, books);
  }
  std::string guard() {
    return said([&] { guard_surface(boundaries.totals(), carried, particles, 60e-6, 120e-6); });
  }
};

TEST(SurfaceGuard_PlateThatJumpsPastItsParticles, NoOtherBookShowsIt_StopsWithCausePlaceAndRemedy) {
  Jump jump(-0.1);
  EXPECT_EQ(jump.gas.size(), 0u) << "all of " << jump.particles << " are behind the plate";
  EXPECT_NEAR(jump.books.escaped_energy, jump.before.kinetic + jump.before.internal, 1e-12 * jump.before.kinetic)
      << "J";
  EXPECT_LT(norm(jump.books.escaped_momentum - jump.before.momentum), 1e-12) << "N s";
  EXPECT_EQ(norm(jump.sheet.total_impulse()), 0.0) << "N s given to the plate";
  const std::string text = jump.guard();
  for (const char* part : {"passed through the plate", "at t = 120 us", "mm", "coupling.window than 60 us"})
    EXPECT_THAT(text, testing::HasSubstr(part));
}

// The same jump with surface_carry: every particle that was not past the sheet before the jump, and is now, lies on it
// (its centre, to rounding of the path of 1 m); velocities, and with them momentum and energy, keep their bits. Many of
// them mean a window too long, as many lost ones would.
TEST(SurfaceCarry_PlateThatJumpsPastItsParticles, NoneIsLost_EnergyKeepsItsBits_GuardStillStops) {
  Jump jump(-0.1, true);
  EXPECT_EQ(jump.gas.size(), static_cast<std::size_t>(jump.particles));
  EXPECT_EQ(jump.carried.particles, jump.particles);
  for (const Vec3& x : jump.gas.position) EXPECT_NEAR(x.z, -0.1, 1e-15) << "m";
  const GasTotals after = gas_totals(jump.gas);
  EXPECT_EQ(after.kinetic, jump.before.kinetic);
  EXPECT_EQ(after.internal, jump.before.internal);
  EXPECT_EQ(jump.boundaries.totals().slipped, 0);
  EXPECT_THAT(jump.guard(), testing::HasSubstr("set back on it"));
}

// Past the sheet by more than a radius before the jump (round an open rim): it stays where it is.
TEST(SurfaceCarry_ParticleBehindBeforeTheJump, StaysBehind) {
  SurfaceSheet sheet{test::flat_mesh(4, 1.5, 1.0), {}};
  GasState gas = test::lattice_gas(1, 0.1, 1.4, 2.0 / 3.0);
  const double depth = gas.radius + 0.05 + 0.02;
  for (Vec3& x : gas.position) x = {0.1, 0.2, 0.05 - depth};
  SurfaceMotion motion = test::at_rest(test::flat_mesh(4, 1.5, 1.0));
  for (Vec3& x : motion.position) x.z = 0.05;
  sheet.begin_window(motion, false);
  CarriedGas carried;
  surface_carry(gas, sheet, 1, carried);
  EXPECT_EQ(carried.particles, 0);
  EXPECT_EQ(gas.position[0].z, 0.05 - depth);
}

TEST(SurfaceGuard_PlateThatStaysBelow, NothingPassed_KeepsQuiet) {
  Jump jump(-1.3);
  EXPECT_EQ(jump.gas.size(), static_cast<std::size_t>(jump.particles));
  EXPECT_EQ(jump.guard(), "");
}

TEST(ParticleEnergyGuard, AtItsLimitBeyondAndWithoutANumber_StopsOnlyBeyond) {
  const CaseSpec spec;
  const auto at = [&](double share) { return said([&] { guard_particle_energy(spec, {}, share, 1e-5); }); };
  EXPECT_EQ(at(largest_open_share), "");
  EXPECT_THAT(at(1.01 * largest_open_share), testing::HasSubstr("energy books are open by 5.05 % at t = 10 us"));
  ParticleLedger ledger;
  ParticleEnergy energy;
  energy.gas_kinetic = 1.0;
  ledger.open(energy, {});
  energy.sand_kinetic = std::nan("");
  EXPECT_NE(at(ledger.observe(energy)), "");
  EXPECT_TRUE(std::isnan(ledger.energy_error())) << "a book that is not a number is not forgotten";
}

}  // namespace
}  // namespace standoff::particles
