// Four elements side by side give the bits of four scalar evaluations, flowing, elastic or far out of the series'
// range: the same operations in the same order (lanes.hpp). So results cannot depend on which elements share a pack.
// Nor on the processor: two Gauss points in one AVX-512 register answer with the bits of one after the other.
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "structure_solver/step/hex_force.hpp"
#include "structure_solver/step/point_laws.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using Law = Metal<Hardening::power, RateLaw::power, true, true>;

template <class T>
struct Element {
  T u[3][hex_nodes];
  T history[hex_points * Law::fields];
  T force[3][hex_nodes];
};

/// Bending and stretching of element `which`, growing with `size`.
double displacement(int component, int node, int which, double size) {
  const auto i = static_cast<std::size_t>(node);
  const double x = lobatto_node[i & 3], y = lobatto_node[i >> 2 & 3], z = lobatto_node[i >> 4];
  const double scale[4] = {1.0, 0.01, 8.0, 0.3};
  const double shape[3] = {x * (1.0 + 0.4 * z) + 0.2 * y, 0.5 * y * y * x - 0.1 * z, -0.3 * z + 0.2 * x * x};
  return size * scale[which] * 0.004 * shape[component];
}

template <class T>
void fresh(Element<T>& e, const MetalParameters& metal) {
  for (T& v : e.history) v = T(0.0);
  for (int q = 0; q < hex_points; ++q) {
    e.history[q * Law::fields + Law::temperature_field] = T(metal.flow.room_temperature);
    e.history[q * Law::fields + Law::static_stress_field] =
        T(static_flow<Hardening::power, true>(metal.flow, 0.0, metal.flow.room_temperature).stress);
  }
}

TEST(Hex64_FourLanes, ElasticFlowingAndFarStrained_HoldTheBitsOfTheScalarElement) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  const BoxGeometry box = BoxGeometry::of_edges(0.04, 0.03, 0.01);
  auto pack = std::make_unique<Element<Pack4>>();
  auto one = std::make_unique<std::array<Element<double>, 4>>();
  fresh(*pack, metal);
  for (auto& e : *one) fresh(e, metal);
  for (int step = 1; step <= 5; ++step) {
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < hex_nodes; ++a)
        for (int i = 0; i < 4; ++i) {
          const double u = displacement(c, a, i, 0.06 * step);
          set_lane(pack->u[c][a], i, u);
          (*one)[static_cast<std::size_t>(i)].u[c][a] = u;
        }
    hex_force<Law>(metal, box, {1e-6, true}, true, pack->u, pack->history, pack->force);
    for (auto& e : *one) hex_force<Law>(metal, box, {1e-6, true}, true, e.u, e.history, e.force);
    for (int i = 0; i < 4; ++i) {
      const Element<double>& scalar = (*one)[static_cast<std::size_t>(i)];
      for (int a = 0; a < hex_nodes; ++a) ASSERT_EQ(lane(pack->force[2][a], i), scalar.force[2][a]) << "lane " << i;
      for (int h = 0; h < hex_points * Law::fields; ++h)
        ASSERT_EQ(lane(pack->history[h], i), scalar.history[h]) << "lane " << i;
    }
  }
  EXPECT_EQ(lane(pack->history[Law::strain_field], 1), 0.0) << "this lane was meant to stay elastic";
  EXPECT_GT(lane(pack->history[Law::strain_field], 0), 1e-3) << "this lane was meant to flow";
}

struct Scene {
  const char* name;
  Hardening hardening;
  RateLaw rate;
  bool heating;
};

class EveryMetal : public ::testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(Points, EveryMetal,
                         ::testing::Values(Scene{"ideal", Hardening::none, RateLaw::none, false},
                                           Scene{"johnson_cook", Hardening::power, RateLaw::power, true},
                                           Scene{"johnson_cook_log", Hardening::power, RateLaw::logarithmic, true},
                                           Scene{"table", Hardening::table, RateLaw::power, true},
                                           Scene{"slow", Hardening::power, RateLaw::none, true}),
                         [](const auto& scene) { return std::string(scene.param.name); });

/// Gradients of 27 points, an odd number, growing with `size`; of very different sizes in the four elements.
std::vector<Pack4> gradients_of_points(int points, double size) {
  std::vector<Pack4> gradient;
  for (int k = 0; k < 9 * points; ++k) {
    Pack4 h;
    for (int i = 0; i < 4; ++i) {
      const double sign = (7 * k + 3 * i) % 11 - 5.0, scale[4] = {1.0, 0.01, 6.0, 0.3};
      set_lane(h, i, 0.2 * size * scale[i] * sign);
    }
    gradient.push_back(h);
  }
  return gradient;
}

TEST_P(EveryMetal, TwoPointsInOneRegister_HoldTheBitsOfOneAfterTheOther) {
  if (widest_here() != Width::eight_lanes) GTEST_SKIP() << "this processor has no AVX-512";
  MetalParameters metal = metal_parameters(testing::al6xn());
  metal.flow.table = hardening_table(std::array{0.0, 0.1, 1.0}, std::array{410e6, 560e6, 1200e6});
  const MetalEffects effects{true, GetParam().hardening, GetParam().rate, GetParam().heating, GetParam().heating};
  const PointLaw four = choose_point_law(effects, Width::four_lanes),
                 eight = choose_point_law(effects, Width::eight_lanes);
  ASSERT_NE(four.update, eight.update);
  constexpr int points = 27;
  const std::vector<double> weight(points, 1e-9);
  std::vector<Pack4> history(static_cast<std::size_t>(points * four.layout.fields), Pack4(0.0));
  for (int q = 0; q < points; ++q) {
    const auto row = static_cast<std::size_t>(q * four.layout.fields);
    if (four.layout.temperature >= 0) history[row + static_cast<std::size_t>(four.layout.temperature)] = 296.0;
    if (four.layout.static_stress >= 0) history[row + static_cast<std::size_t>(four.layout.static_stress)] = 410e6;
  }
  std::vector<Pack4> history_of_eight = history;
  for (int step = 1; step <= 5; ++step) {
    std::vector<Pack4> g = gradients_of_points(points, 2e-3 * step), same = g;
    const auto a = four.update(metal, {1e-6, true}, true, points, weight.data(), g.data(), history.data());
    const auto b = eight.update(metal, {1e-6, true}, true, points, weight.data(), same.data(), history_of_eight.data());
    ASSERT_EQ(0, std::memcmp(g.data(), same.data(), g.size() * sizeof(Pack4)));
    ASSERT_EQ(0, std::memcmp(history.data(), history_of_eight.data(), history.size() * sizeof(Pack4)));
    ASSERT_EQ(0, std::memcmp(&a, &b, sizeof a));
  }
  double most = 0.0, least = 1.0;
  for (int q = 0; q < points; ++q)
    for (int i = 0; i < 4; ++i) {
      const double p = lane(history[static_cast<std::size_t>(q * four.layout.fields + four.layout.strain)], i);
      most = std::max(most, p), least = std::min(least, p);
    }
  EXPECT_EQ(least, 0.0) << "one element was meant to stay elastic";
  EXPECT_GT(most, 1e-2) << "one element was meant to flow far";
}

}  // namespace
}  // namespace standoff::structure
