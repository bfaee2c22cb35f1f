// Flow curves of AL-6XN from the point driver over seven decades of rate, and the two points where a specimen gives
// way.
//   isothermal  sigma = (A + B p^n)(1 + rate/rate0)^C                       [Borvik 2011, eq. 3]
//   necking     d sigma / d eps = sigma, engineering stress sigma exp(-eps)
//   adiabatic   rho cp dT = chi sigma dp; the stress has a maximum where softening overtakes hardening (shear bands)
// The driver holds the plastic rate to 1e-8 and the stress to C times that: isothermal stresses are the closed form to
// 1e-9. Necking and adiabatic maxima are from an independent integration to convergence: tables printed to
// 1e-6 of p and 1e-3 MPa; here backward Euler in steps of 2.5e-4, first order, half a step of softening: 2e-5 of the
// stress, and a flat maximum is found to sqrt of that in p: 5e-3.
#include <algorithm>

#include <gtest/gtest.h>

#include "structure_solver/materials/point_driver.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using Static = Metal<Hardening::power, RateLaw::none, false, false>;
using Isothermal = Metal<Hardening::power, RateLaw::power, false, false>;
using Adiabatic = Metal<Hardening::power, RateLaw::power, true, false>;

MetalParameters steel() {
  return metal_parameters(testing::al6xn());
}

TEST(PointDriver_Isothermal, FromAThousandthToTenThousandPerSecond_IsTheClosedForm) {
  const JohnsonCook law = steel().flow;
  for (const double rate : {1e-3, 1e-2, 1e-1, 1.0, 1e1, 1e2, 1e3, 1e4})
    for (const PointState& at : trace_point<Isothermal>(steel(), {rate, 0.5, 50})) {
      const double flow =
          (law.A + law.B * std::pow(at.plastic_strain, law.n)) * std::pow(1.0 + rate / law.reference_rate, law.C);
      ASSERT_NEAR(at.stress, flow, 1e-9 * flow) << "Pa at p = " << at.plastic_strain << ", rate " << rate;
    }
}

// (A + B p^n)(1 + rate)^C (1 - T*^m) at a held temperature.
TEST(PointDriver_HeldTemperature, FromRoomToNearMelting_SoftensAsTheLaw) {
  const JohnsonCook law = steel().flow;
  for (const double kelvin : {296.0, 500.0, 900.0, 1400.0, 1699.0}) {
    const PointState at = trace_point<Adiabatic>(steel(), {1.0, 0.2, 20, kelvin, true}).back();
    const double softening = 1.0 - std::pow((kelvin - 296.0) / (1700.0 - 296.0), law.m);
    const double flow = (law.A + law.B * std::pow(0.2, law.n)) * std::pow(1001.0, law.C) * softening;
    EXPECT_NEAR(at.stress, flow, 1e-9 * flow + 4e-10 * law.A) << "Pa at " << kelvin << " K";
    EXPECT_EQ(at.temperature, kelvin);
  }
}

// Heat is the plastic work, to rounding of the sum: 400 steps.
TEST(PointDriver_Adiabatic, AnyRate_HeatIsTheShareOfTheWork) {
  for (const double rate : {1e-3, 1.0, 1e4}) {
    const PointState end = trace_point<Adiabatic>(steel(), {rate, 0.5, 400}).back();
    EXPECT_NEAR((end.temperature - 296.0) / (steel().heating * end.work), 1.0, 1e-12) << "rate " << rate;
  }
}

TEST(PointDriver_Necking, StaticCurve_IsWhereHardeningEqualsStress) {
  double engineering = 0.0, at = 0.0, true_stress = 0.0;
  for (const PointState& s : trace_point<Static>(steel(), {1.0, 0.8, 3200})) {
    const double nominal = s.stress * std::exp(-s.plastic_strain);
    if (nominal > engineering) engineering = nominal, at = s.plastic_strain, true_stress = s.stress;
  }
  EXPECT_NEAR(at, 0.622090, 2.5e-4) << "one step";
  EXPECT_NEAR(1e-6 * true_stress, 1698.755, 2.5e-4 * 1698.755) << "MPa";
  EXPECT_NEAR(1e-6 * engineering, 911.928, 1e-3) << "MPa; flat at its maximum";
}

TEST(PointDriver_AdiabaticMaximum, SlowAndFast_LiesWhereTheIntegratedLawHasIt) {
  struct Expected {
    double rate, strain, mpa;
  };
  for (const Expected& e : {Expected{1e-3, 1.4598, 2004.22}, {1e3, 1.1961, 2397.77}}) {
    const auto curve = trace_point<Adiabatic>(steel(), {e.rate, 1.8, 7200});
    const PointState top = *std::ranges::max_element(curve, {}, &PointState::stress);
    EXPECT_NEAR(top.plastic_strain, e.strain, 5e-3) << "rate " << e.rate;
    EXPECT_NEAR(1e-6 * top.stress, e.mpa, 5e-5 * e.mpa) << "MPa, rate " << e.rate;
  }
}

}  // namespace
}  // namespace standoff::structure
