// Johnson-Cook flow curves of AL-6XN at a point, from the closed form with the constants of [Borvik 2011, table 3]:
//   static and isothermal: (A + B p^n)(1 + rate/rate0)^C; adiabatic: the same times 1 - T*^m with rho cp dT = chi sigma
//   dp,
// integrated to convergence independently. The point is stretched isochorically so that plastic strain grows at `rate`.
// Tolerance: tables are printed to 1e-3 MPa (isothermal) and 1e-2 MPa, 1e-2 or 0.1 K (adiabatic); the driver keeps the
// plastic rate within 1e-3 (C times that: 3e-5 of the stress), and backward Euler in 4000 steps to p = 0.5 is first
// order: half a step of softening, 4e-5. Hence 1e-4 relative; static 1e-6 (digits of the table, interpolation between
// steps).
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using Row = std::pair<double, double>;  // plastic strain, MPa

struct Point {
  double strain, stress, rise;  // -, MPa, K
};

/// Stretches a point to `target` plastic strain at `rate`; rate 0 is the static curve.
template <class Law>
Point stretch(double target, double rate, int steps = 4000) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  const double step = target / steps, dt = rate > 0.0 ? step / rate : 0.0;
  PointHistory<double> s{};
  s.temperature = metal.flow.room_temperature;
  s.static_stress = static_flow<Hardening::power, true>(metal.flow, 0.0, s.temperature).stress;
  double stretch_log = 0.0, stress = 0.0, gain = 0.0;
  Point last{}, now{0.0, 0.0, 0.0};
  while (now.strain < target) {
    // Plastic strain lags the stretch by the growth of the elastic strain: add what it grew in the last step.
    stretch_log += step + gain;
    const double a = std::expm1(stretch_log), b = std::expm1(-0.5 * stretch_log);
    const Mat3<double> h{{{a, 0, 0}, {0, b, 0}, {0, 0, b}}};
    const PointResult<double> r = update_point<Law>(metal, h, {dt, true}, s);
    const double before = stress;
    stress = r.p.m[0][0] * (1.0 + a) - r.p.m[1][1] * (1.0 + b);
    gain = s.strain > 0.0 ? (stress - before) / (3.0 * metal.shear) : 0.0;
    last = now;
    now = {s.strain, 1e-6 * stress, s.temperature - metal.flow.room_temperature};
  }
  const double share = (target - last.strain) / (now.strain - last.strain);
  return {target, std::lerp(last.stress, now.stress, share), std::lerp(last.rise, now.rise, share)};
}

using Isothermal = Metal<Hardening::power, RateLaw::power, false, false>;
using Static = Metal<Hardening::power, RateLaw::none, false, false>;
using Adiabatic = Metal<Hardening::power, RateLaw::power, true, false>;

TEST(JohnsonCook_StaticCurve, AlongPlasticStrain_FollowsTheClosedForm) {
  for (const auto& [p, mpa] :
       std::vector<Row>{{.02, 486.923}, {.05, 573.067}, {.1, 697.879}, {.2, 918.224}, {.5, 1487.373}}) {
    EXPECT_NEAR(stretch<Static>(p, 0.0).stress, mpa, 1e-6 * mpa) << "MPa at p = " << p;
  }
}

TEST(JohnsonCook_IsothermalCurve, AtOnePerSecondAndAThousand_FollowsTheClosedForm) {
  const std::vector<std::pair<double, std::vector<Row>>> tables = {
      {1.0, {{.02, 574.739}, {.05, 676.419}, {.1, 823.741}, {.2, 1083.825}, {.5, 1755.619}}},
      {1e3, {{.02, 678.360}, {.05, 798.372}, {.1, 972.255}, {.2, 1279.230}, {.5, 2072.144}}}};
  for (const auto& [rate, rows] : tables)
    for (const auto& [p, mpa] : rows)
      EXPECT_NEAR(stretch<Isothermal>(p, rate).stress, mpa, 1e-4 * mpa) << "MPa at p = " << p << ", rate " << rate;
}

TEST(JohnsonCook_AdiabaticCurve, AtOnePerSecondAndAThousand_FollowsTheIntegratedLaw) {
  struct Expected {
    double rate, p, mpa, kelvin;
  };
  for (const Expected& e : {Expected{1, .05, 673.72, 6.57},
                            {1, .1, 816.11, 14.91},
                            {1, .2, 1058.98, 35.93},
                            {1, .5, 1608.43, 126.5},
                            {1e3, .05, 794.60, 7.75},
                            {1e3, .1, 961.58, 17.58},
                            {1e3, .2, 1244.52, 42.31},
                            {1e3, .5, 1867.74, 148.2}}) {
    const Point point = stretch<Adiabatic>(e.p, e.rate);
    EXPECT_NEAR(point.stress, e.mpa, 1e-4 * e.mpa) << "MPa at p = " << e.p << ", rate " << e.rate;
    EXPECT_NEAR(point.rise, e.kelvin, 1e-3 * e.kelvin + 0.005) << "K at p = " << e.p << ", rate " << e.rate;
  }
}

// The original law has no rate effect below its reference rate and 1 + C ln(rate/rate0) above.
TEST(JohnsonCook_LogarithmicRate, AboveAndBelowTheReferenceRate_FollowsTheOriginalLaw) {
  using Logarithmic = Metal<Hardening::power, RateLaw::logarithmic, false, false>;
  const double p = 0.1, base = 697.879;
  EXPECT_NEAR(stretch<Logarithmic>(p, 1.0).stress, base * (1.0 + 0.024 * std::log(1e3)), 1e-4 * base);
  EXPECT_NEAR(stretch<Logarithmic>(p, 0.5e-3).stress, base, 1e-4 * base);
}

}  // namespace
}  // namespace standoff::structure
