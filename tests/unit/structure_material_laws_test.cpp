// The laws beside Johnson-Cook: a table of straight lines, and no yield at all. Closed forms; return map 1e-10 of the
// yield stress, its own tolerance; rounding of stresses of 1e-3 strain elsewhere, 1e-12.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

constexpr std::array<double, 4> strains{0.0, 0.01, 0.05, 0.2}, stresses{400e6, 460e6, 540e6, 600e6};

MetalParameters table_metal() {
  MetalParameters metal = metal_parameters(testing::al6xn());
  metal.flow.A = stresses[0];
  metal.flow.table = hardening_table(strains, stresses);
  return metal;
}

double by_lines(double p) {
  for (std::size_t k = 0; k + 1 < strains.size(); ++k)
    if (p < strains[k + 1])
      return std::lerp(stresses[k], stresses[k + 1], (p - strains[k]) / (strains[k + 1] - strains[k]));
  return stresses.back();
}

// The sum of bends is the polygon through the points, level after the last one; its slope is the line's.
TEST(HardeningTable_SumOfBends, BetweenAndBeyondPoints_IsThePolygon) {
  const MetalParameters metal = table_metal();
  for (const double p : {0.0, 1e-9, 0.004, 0.01, 0.03, 0.1999, 0.2, 0.7, 3.0}) {
    const auto flow = static_flow<Hardening::table, false>(metal.flow, p, 296.0);
    EXPECT_NEAR(flow.stress, by_lines(p), 1e-12 * stresses[3]) << "Pa at p = " << p;
    EXPECT_NEAR(flow.by_strain, (by_lines(p + 1e-6) - by_lines(p)) * 1e6, 10.0) << "Pa at p = " << p;
  }
}

// Steps that jump over one or several corners end on the yield surface all the same, with rate and heat and without.
template <RateLaw Rate, bool Softening>
void expect_on_table(double overstress, double strain, double dt) {
  const MetalParameters metal = table_metal();
  const double triple_shear = 3.0 * metal.shear, yield = by_lines(strain);
  const FlowProblem<double> f{yield * (1.0 + overstress),
                              1.0,
                              strain,
                              296.0,
                              triple_shear,
                              Softening ? metal.heating : 0.0,
                              Rate == RateLaw::none ? 0.0 : 1e-3 * dt};
  const auto r = solve_flow<Hardening::table, Softening, Rate>(metal.flow, f, true, 0.0);
  const double flow = static_flow<Hardening::table, Softening>(metal.flow, strain + r.increment, r.temperature).stress;
  double factor = 1.0;
  if (Rate == RateLaw::power) factor = std::pow(1.0 + r.increment / f.rate_strain, metal.flow.C);
  if (Rate == RateLaw::logarithmic) factor = 1.0 + metal.flow.C * std::log(std::max(1.0, r.increment / f.rate_strain));
  EXPECT_LE(std::fabs(f.trial - triple_shear * r.increment - flow * factor), 4e-10 * metal.flow.A + 4e-16 * f.trial)
      << "Pa, overstress " << overstress << ", p " << strain << ", dp " << r.increment;
  EXPECT_GE(r.increment, 0.0);
}

TEST(HardeningTable_ReturnMap, AcrossCorners_EndsOnTheYieldSurface) {
  for (const double overstress : {1e-9, 0.3, 8.0, 200.0})
    for (const double strain : {0.0, 0.0099999, 0.01, 0.049, 0.3}) {
      expect_on_table<RateLaw::none, false>(overstress, strain, 0.0);
      expect_on_table<RateLaw::power, false>(overstress, strain, 1.2e-7);
      expect_on_table<RateLaw::power, true>(overstress, strain, 1.2e-7);
      expect_on_table<RateLaw::logarithmic, true>(overstress, strain, 1.2e-7);
    }
}

// Uniaxial stress 3 G dev(eps) without limit, and nothing remembered: no history to go wrong.
TEST(ElasticLaw_AnyStretch, FarBeyondYield_IsHenckyElasticWithoutHistory) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  for (const double e : {1e-6, 1e-3, 0.02, 0.3}) {
    PointHistory<double> s{};
    const double a = std::expm1(e), b = std::expm1(-0.5 * e);
    const auto r = update_point<Elastic>(metal, Mat3<double>{{{a, 0, 0}, {0, b, 0}, {0, 0, b}}}, {1e-6, true}, s);
    const double difference = r.p.m[0][0] * (1.0 + a) - r.p.m[1][1] * (1.0 + b);
    EXPECT_NEAR(difference, 3.0 * metal.shear * e, 1e-12 * 3.0 * metal.shear * e + 1e-4) << "Pa at " << e;
    EXPECT_NEAR(r.elastic, 1.5 * metal.shear * e * e, 1e-11 * metal.shear * e * e) << "J/m3 at " << e;
    EXPECT_EQ(s.strain, 0.0);
  }
}

// A closed path of large stretch, shear and rotation gives back all work: the stress has a stored energy. Trapezoidal
// work of 4000 chords is second order in their length: 1e-5 of the largest energy; the end stress is zero to rounding.
TEST(ElasticLaw_ClosedCycle, LargeStretchAndRotation_GivesBackAllWork) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  const auto path = [](double t) {
    const double s = std::pow(std::sin(M_PI * t), 2), w = std::sin(2.0 * M_PI * t), v = std::sin(4.0 * M_PI * t);
    return Mat3<double>{{{0.3 * s, 0.4 * w, 0.1 * v}, {-0.3 * w, 0.2 * v, 0.2 * s}, {0.1 * s, -0.2 * v, -0.2 * s}}};
  };
  PointHistory<double> none{};
  Mat3<double> before = path(0.0);
  PointResult<double> old = update_point<Elastic>(metal, before, {}, none);
  double work = 0.0, largest = 0.0;
  for (int i = 1; i <= 4000; ++i) {
    const Mat3<double> now = i == 4000 ? path(0.0) : path(i / 4000.0);
    const PointResult<double> r = update_point<Elastic>(metal, now, {}, none);
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) work += 0.5 * (old.p.m[j][k] + r.p.m[j][k]) * (now.m[j][k] - before.m[j][k]);
    ASSERT_NEAR(work, r.elastic, 1e-5 * metal.shear) << "J/m3, chord " << i;
    largest = std::max(largest, r.elastic);
    before = now, old = r;
  }
  EXPECT_GT(largest, 0.05 * metal.shear) << "J/m3; the cycle was meant to be large";
  EXPECT_LT(std::fabs(work), 1e-5 * largest) << "J/m3";
  EXPECT_LT(std::fabs(old.p.m[0][1]), 1e-9 * metal.shear) << "Pa";
}

// The plate keeps no history at all when it does not yield, and answers an impulse without a loss.
TEST(PlateEffects_Plasticity, Off_KeepsNoHistoryAndNoPlasticWork) {
  CaseSpec spec = testing::plate_case(2, true);
  spec.plate.material.law = MaterialLaw::elastic;
  PlateHex64 model(spec, 1);
  EXPECT_EQ(model.plate().forces().history_bytes(), 0u);
  testing::give_impulse(model, 60.0);
  const double energy = model.ledger().kinetic;
  for (int i = 0; i < 400; ++i) model.step(model.stable_step());
  EXPECT_EQ(model.ledger().plastic, 0.0);
  EXPECT_NEAR(model.ledger().kinetic + model.ledger().elastic, energy, 5e-3 * energy) << "J";
}

}  // namespace
}  // namespace standoff::structure
