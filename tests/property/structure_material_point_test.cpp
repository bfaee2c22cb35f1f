// Laws every material point keeps at finite strain: objectivity, consistency of flow and stress, heat from work,
// isochoric flow, the stress as gradient of the stored energy. Tolerances are stated with each law.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using Law = Metal<Hardening::power, RateLaw::power, true, true>;

PointHistory<double> virgin(const MetalParameters& metal) {
  PointHistory<double> s{};
  s.temperature = metal.flow.room_temperature;
  s.static_stress = static_flow<Hardening::power, true>(metal.flow, 0.0, s.temperature).stress;
  return s;
}

Mat3<double> multiply(const Mat3<double>& a, const Mat3<double>& b) {
  Mat3<double> r{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) r.m[i][j] += a.m[i][k] * b.m[k][j];
  return r;
}

Mat3<double> minus_identity(Mat3<double> f) {
  for (int i = 0; i < 3; ++i) f.m[i][i] -= 1.0;
  return f;
}

/// Cauchy stress P F^T / J.
Mat3<double> cauchy(const PointResult<double>& r, const Mat3<double>& h) {
  Mat3<double> s = multiply(r.p, transpose(deformation_gradient(h)));
  for (auto& row : s.m)
    for (double& v : row) v /= r.volume_ratio;
  return s;
}

double mises(const Mat3<double>& s) {
  const double p = (s.m[0][0] + s.m[1][1] + s.m[2][2]) / 3.0;
  double sum = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum += std::pow(s.m[i][j] - (i == j ? p : 0.0), 2);
  return std::sqrt(1.5 * sum);
}

const Mat3<double> stretched{{{0.011, 0.004, -0.002}, {0.001, -0.006, 0.003}, {0.002, -0.001, 0.005}}};

Mat3<double> turned(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

// A stressed, plastically deformed point is turned through 360 degrees in 10^4 steps: the Mises stress and the mean
// stress stay. Rounding: be - I of order 0.01 carries eps, i.e. 2e-14 relative; ten times that for cofactors and
// products.
TEST(MaterialPoint_RigidRotation, FullTurn_KeepsStressInvariantsAndHistory) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  PointHistory<double> s = virgin(metal);
  update_point<Law>(metal, stretched, {1e-6, true}, s);
  const Mat3<double> f = deformation_gradient(stretched);
  const PointHistory<double> committed = s;
  const PointResult<double> first = update_point<Law>(metal, stretched, {0.0, false}, s);
  const double expected = mises(cauchy(first, stretched));
  ASSERT_GT(s.strain, 1e-3);
  for (int i = 0; i <= 10000; ++i) {
    const Mat3<double> h = minus_identity(multiply(turned(2.0 * M_PI * i / 10000.0), f));
    const PointResult<double> r = update_point<Law>(metal, h, {0.0, false}, s);
    ASSERT_NEAR(mises(cauchy(r, h)) / expected, 1.0, 1e-12) << "step " << i;
    ASSERT_NEAR(r.elastic / first.elastic, 1.0, 1e-12) << "step " << i;
  }
  EXPECT_EQ(s.strain, committed.strain);
  EXPECT_EQ(s.c.xy, committed.c.xy);
}

// In uniaxial stretch and in simple shear the Mises stress follows (A + B p^n)(1 + rate/rate0)^C (1 - T*^m) at the
// point's own p, rate and T, to the tolerance of the return map (1e-10 A) and rounding of the stress (1e-13 of 2 G).
TEST(MaterialPoint_UniaxialAndShear, WhileFlowing_StressLiesOnTheFlowCurve) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  for (const bool shear : {false, true}) {
    PointHistory<double> s = virgin(metal);
    const double dt = 1.2e-7, rate = 2e3;
    for (int i = 1; i <= 500; ++i) {
      const double e = rate * dt * i;
      const Mat3<double> h =
          shear ? Mat3<double>{{{0, e, 0}, {0, 0, 0}, {0, 0, 0}}} : Mat3<double>{{{e, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
      const double before = s.strain;
      const PointResult<double> r = update_point<Law>(metal, h, {dt, true}, s);
      if (s.strain == before) continue;
      const double flow = static_flow<Hardening::power, true>(metal.flow, s.strain, s.temperature).stress *
                          std::pow(1.0 + (s.strain - before) / dt / metal.flow.reference_rate, metal.flow.C);
      ASSERT_NEAR(mises(cauchy(r, h)), flow, 1e-9 * flow) << (shear ? "shear " : "uniaxial ") << i;
    }
    EXPECT_GT(s.strain, 0.05);
  }
}

// rho cp dT = chi W_p, and flow keeps the volume: det Cp = 1. 2000 steps of rounding, each below 4 eps: 2e-12.
TEST(MaterialPoint_CyclicShear, ManySteps_HeatMatchesWorkAndFlowIsIsochoric) {
  using NoExpansion = Metal<Hardening::power, RateLaw::power, true, false>;
  const MetalParameters metal = metal_parameters(testing::al6xn());
  PointHistory<double> s = virgin(metal);
  double work = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double e = 0.1 * std::sin(0.01 * i);
    work += update_point<NoExpansion>(metal, {{{0, e, 0}, {0, 0.3 * e, 0}, {0, e, 0}}}, {1e-6, true}, s).inelastic;
  }
  EXPECT_NEAR((s.temperature - 296.0) / (metal.heating * work), 1.0, 1e-12);
  const Sym3<double> metric{1.0 + s.c.xx, 1.0 + s.c.yy, 1.0 + s.c.zz, s.c.xy, s.c.yz, s.c.zx};
  EXPECT_NEAR(determinant(metric), 1.0, 2e-12);
  EXPECT_GT(s.strain, 0.3);
}

// P is the derivative of the stored energy by F at frozen flow: central difference with step 1e-6, error d^2 = 1e-12 of
// the modulus over strain 1e-2, rounding eps energy / d / P = 1e-8.
TEST(MaterialPoint_FrozenFlow, AnyDirection_StressIsTheGradientOfStoredEnergy) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  PointHistory<double> s = virgin(metal);
  update_point<Law>(metal, stretched, {1e-6, true}, s);
  const PointResult<double> r = update_point<Law>(metal, stretched, {0.0, false}, s);
  const double scale = mises(r.p);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Mat3<double> up = stretched, down = stretched;
      up.m[i][j] += 1e-6, down.m[i][j] -= 1e-6;
      const double slope = (update_point<Law>(metal, up, {0.0, false}, s).elastic -
                            update_point<Law>(metal, down, {0.0, false}, s).elastic) /
                           2e-6;
      EXPECT_NEAR(r.p.m[i][j], slope, 1e-7 * scale) << "component " << i << j << ", Pa";
    }
}

}  // namespace
}  // namespace standoff::structure
