// The return map where it is hardest: every case must end on the yield surface, |g| <= 1e-10 A (the tolerance it
// promises; 4e-10 A is asserted, for the rounding of g re-evaluated here at trial stresses up to 500 A), with dp >= 0
// and finite.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "structure_solver/materials/plastic_flow.hpp"

namespace standoff::structure {
namespace {

constexpr double triple_shear = 225e9;
const JohnsonCook steel{410e6, 1902e6, 0.82, 0.024, 1e-3, 1.03, 296.0, 1700.0};
constexpr double heating = 0.9 / (8060.0 * 500.0);

struct Hard {
  std::string what;
  JohnsonCook law;
  double overstress;  // trial over static flow stress, minus 1
  double strain, temperature, dt, beta;
};

JohnsonCook with(auto change) {
  JohnsonCook law = steel;
  change(law);
  return law;
}

std::vector<Hard> hard_cases() {
  return {{"ordinary", steel, 0.5, 0.01, 300, 1.2e-7, heating},
          {"flow of about 1e-14", steel, 1e-9, 0.01, 300, 1.2e-7, heating},
          {"flow of about one half in a step", steel, 200.0, 0.1, 300, 1.2e-7, 0.0},
          {"half in a step, heated", steel, 60.0, 0.1, 300, 1.2e-7, heating},
          {"just above yield", steel, 2e-10, 0.05, 300, 1.2e-7, heating},
          {"a long step", steel, 0.5, 0.01, 300, 1.0, heating},
          {"a very short step", steel, 0.5, 0.01, 300, 1e-13, heating},
          {"a hair below melting", steel, 3.0, 0.2, 1700 - 1e-9, 1.2e-7, heating},
          {"molten", steel, 3.0, 0.2, 1800, 1.2e-7, heating},
          {"colder than room", steel, 0.5, 0.01, 77, 1.2e-7, heating},
          {"virgin, n = 0.05", with([](auto& l) { l.n = 0.05; }), 0.5, 0.0, 300, 1.2e-7, heating},
          {"virgin, n = 0.31, m = 0.7", with([](auto& l) { l.n = 0.31, l.m = 0.7; }), 0.5, 0.0, 296, 1.2e-7, heating},
          {"C = 0", with([](auto& l) { l.C = 0.0; }), 0.5, 0.01, 300, 1.2e-7, heating},
          {"B = 0", with([](auto& l) { l.B = 0.0; }), 0.5, 0.01, 300, 1.2e-7, heating},
          {"chi = 0", steel, 0.5, 0.01, 300, 1.2e-7, 0.0}};
}

template <RateLaw Rate>
void expect_on_yield_surface(const Hard& c, double guess) {
  const double yield = static_flow<Hardening::power, true>(c.law, c.strain, c.temperature).stress;
  const FlowProblem<double> f{yield * (1.0 + c.overstress),
                              1.0,
                              c.strain,
                              c.temperature,
                              triple_shear,
                              c.beta,
                              Rate == RateLaw::none ? 0.0 : c.law.reference_rate * c.dt};
  const FlowResult<double> r = solve_flow<Hardening::power, true, Rate>(c.law, f, true, guess);
  const double flow = static_flow<Hardening::power, true>(c.law, c.strain + r.increment, r.temperature).stress;
  double factor = 1.0;
  if (Rate == RateLaw::power) factor = std::pow(1.0 + r.increment / f.rate_strain, c.law.C);
  if (Rate == RateLaw::logarithmic) factor = 1.0 + c.law.C * std::log(std::max(1.0, r.increment / f.rate_strain));
  const double g = f.trial - triple_shear * r.increment - flow * factor;
  EXPECT_GE(r.increment, 0.0) << c.what;
  EXPECT_LE(std::fabs(g), 4e-10 * c.law.A + 4e-16 * f.trial) << c.what << ": g in Pa, dp = " << r.increment;
  EXPECT_NEAR(r.static_stress, flow, 4e-10 * c.law.A) << c.what;
  EXPECT_TRUE(std::isfinite(r.temperature)) << c.what;
}

TEST(ReturnMap_HardCases, AnyGuess_EndsOnTheYieldSurface) {
  for (const Hard& c : hard_cases())
    for (const double guess : {0.0, 1e-3, 10.0, 30.0}) {
      expect_on_yield_surface<RateLaw::power>(c, guess);
      expect_on_yield_surface<RateLaw::logarithmic>(c, guess);
      expect_on_yield_surface<RateLaw::none>(c, 1e-3 * guess);
    }
}

// Flow stress at rates jumping 0 -> 1e6 -> 0 within three steps: no memory of the old rate, no chatter.
TEST(ReturnMap_RateJumps, UpAndDownAgain_GiveTheSameAnswerAsAFreshPoint) {
  const auto solve = [](double overstress, double guess) {
    const double yield = static_flow<Hardening::power, true>(steel, 0.01, 300.0).stress;
    const FlowProblem<double> f{yield * (1.0 + overstress), 1.0, 0.01, 300.0, triple_shear, heating, 1e-3 * 1.2e-7};
    return solve_flow<Hardening::power, true, RateLaw::power>(steel, f, true, guess);
  };
  double x = 0.0;
  for (const double overstress : {1e-6, 60.0, 1e-6}) {
    const FlowResult<double> jumped = solve(overstress, x), fresh = solve(overstress, 0.0);
    // Both satisfy |g| <= 1e-10 A; the slope of g by dp is at least 3 G.
    EXPECT_NEAR(jumped.increment, fresh.increment, 2e-10 * steel.A / triple_shear);
    x = jumped.x;
  }
}

TEST(ReturnMap_FourLanes, OneHardOneEasyOneIdle_HoldTheBitsOfTheScalarSolve) {
  const double trial[4] = {600e6, 410e6 * 200, 500e6, 3e9};
  FlowProblem<Pack4> f{
      Pack4(Pack4::Raw{trial[0], trial[1], trial[2], trial[3]}), 1.0, 0.01, 300.0, triple_shear, heating, 1.2e-10};
  const Mask4 active{Mask4::Raw{-1, -1, 0, -1}};
  const auto pack = solve_flow<Hardening::power, true, RateLaw::power>(steel, f, active, Pack4(12.0));
  for (const int i : {0, 1, 3}) {
    const FlowProblem<double> one{trial[i], 1.0, 0.01, 300.0, triple_shear, heating, 1.2e-10};
    const auto scalar = solve_flow<Hardening::power, true, RateLaw::power>(steel, one, true, 12.0);
    EXPECT_EQ(lane(pack.increment, i), scalar.increment) << "lane " << i;
    EXPECT_EQ(lane(pack.temperature, i), scalar.temperature) << "lane " << i;
  }
  EXPECT_EQ(lane(pack.increment, 2), 0.0) << "a lane that does not yield must not flow";
}

}  // namespace
}  // namespace standoff::structure
