// Four elements side by side give the bits of four scalar evaluations, flowing, elastic or far out of the series'
// range: the same operations in the same order (lanes.hpp). So results cannot depend on which elements share a pack.
#include <memory>

#include <gtest/gtest.h>

#include "structure_solver/step/hex_force.hpp"
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

}  // namespace
}  // namespace standoff::structure
