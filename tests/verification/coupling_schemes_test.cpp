// Law: a mass M on a spring K in a steady stream of particles that stick for a moment, mass flow m and speed u:
//   M x'' + m x' + K x = m u,   x(t) = (m u / K) (1 - exp(-g t) (cos w t + g/w sin w t)),  g = m / 2M, w^2 = K/M - g^2
// The load side knows the speed of the mass at the begin of a window and holds the force over it; the mass moves
// exactly under a constant force. So the only error is the age of what the sides know of each other: half a window on
// average in the serial scheme, one window more in the parallel one. Both are of first order in the window H: e(H) /
// e(H/2) -> 2. Tolerances: the next term of the error is of second order, so the ratio differs from 2 by a term that
// halves with H; what is left after Richardson's extrapolation is of second order, below a tenth of the error here.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/contract/coupling_harness.hpp"

namespace standoff::test {
namespace {

constexpr double mass = 1.0, spring = 40.0, flow = 2.0, speed = 3.0;  // kg, N/m, kg/s, m/s
constexpr double end = 1.0;                                           // s

double exact(double t) {
  const double g = 0.5 * flow / mass, w = std::sqrt(spring / mass - g * g);
  return flow * speed / spring * (1.0 - std::exp(-g * t) * (std::cos(w * t) + g / w * std::sin(w * t)));
}

void stream(Participant& link) {
  const std::size_t nodes = link.receive_surface().position.size();
  const CouplingClock clock = link.ready({1e-3, 0.0});
  InterfaceTotals totals;
  while (const auto grant = link.next()) {
    SurfaceLoad load{std::vector<Vec3>(nodes)};
    load.force[0].z = flow * (speed - grant->motion.velocity[0].z);
    totals.impulse += load.force[0] * clock.window;
    link.advance(load, totals);
  }
  link.finish("{}");
}

void mass_on_a_spring(Participant& link) {
  const SurfaceMesh mesh = strip(1);
  link.offer_surface(mesh);
  const CouplingClock clock = link.ready({1e-3, 0.0});
  SurfaceMotion motion{mesh.position, std::vector<Vec3>(mesh.position.size())};
  const double w = std::sqrt(spring / mass), c = std::cos(w * clock.window), s = std::sin(w * clock.window);
  double x = 0.0, v = 0.0, at_end = 0.0;
  InterfaceTotals totals;
  while (const auto grant = link.next()) {
    const double rest = grant->load.force[0].z / spring, from = x - rest;
    totals.impulse += grant->load.force[0] * clock.window;
    x = rest + from * c + v / w * s, v = -from * w * s + v * c;
    if (!grant->drain) at_end = x;
    motion.position[0].z = x, motion.velocity[0].z = v;
    link.advance(motion, totals);
  }
  link.finish(nlohmann::json{{"x", at_end}}.dump());
}

/// x(end) - exact with `windows` windows.
double error(bool parallel, int windows) {
  CoupledRun run;
  run.broker.rules.until = end;
  run.broker.rules.parallel = parallel;
  run.broker.rules.window = {WindowRule::Kind::fixed, end / windows};
  Child broker = run.start_broker();
  Child load = run.start(run.options(Role::load), stream);
  Child structure = run.start(run.options(Role::structure), mass_on_a_spring);
  EXPECT_EQ(broker.wait(), 0) << run.errors("broker");
  EXPECT_EQ(load.wait(), 0) << run.errors("particles");
  EXPECT_EQ(structure.wait(), 0) << run.errors("structure");
  for (const nlohmann::json& event : run.events("report"))
    if (event["name"] == "structure") return event["report"]["x"].get<double>() - exact(end);
  ADD_FAILURE() << "the structure did not report";
  return 0.0;
}

class Schemes : public testing::TestWithParam<bool> {};

TEST_P(Schemes, WindowHalved_HalvesTheError) {
  const double coarse = error(GetParam(), 256), middle = error(GetParam(), 512), fine = error(GetParam(), 1024);
  const double first = coarse / middle, second = middle / fine;
  EXPECT_NEAR(second, 2.0, 0.1) << "e = " << coarse << ", " << middle << ", " << fine << " m";
  EXPECT_LT(std::abs(second - 2.0), 0.7 * std::abs(first - 2.0));
  EXPECT_LT(std::abs(2.0 * fine - middle), 0.1 * std::abs(fine)) << "what extrapolation leaves is of second order";
}

INSTANTIATE_TEST_SUITE_P(Coupling, Schemes, testing::Bool(),
                         [](const auto& given) { return given.param ? "parallel" : "serial"; });

TEST(SchemesCompared, Serial_KnowsMoreOfTheOtherSideThanParallel) {
  EXPECT_LT(2.0 * std::abs(error(false, 128)), std::abs(error(true, 128)));
}

}  // namespace
}  // namespace standoff::test
