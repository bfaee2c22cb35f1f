// A stressed, yielded element turned through 360 degrees in 10^4 committed steps: nothing may change but the direction
// of its forces. Rate-independent flow, so that the committed state lies on its yield surface and stays there. Rounding
// of a displacement gradient of order 1 is 2e-16 in strain; over strains of 1e-2 and 10^4 steps, if errors added up,
// 1e-10.
#include <cmath>

#include <gtest/gtest.h>

#include "structure_solver/step/hex_force.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

using Law = Metal<Hardening::power, RateLaw::none, true, false>;
using Nodal = double[3][hex_nodes];

/// Turned about z by `angle` after the displacement `u`.
void turned(const Nodal& x, const Nodal& u, double angle, Nodal& out) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (int a = 0; a < hex_nodes; ++a) {
    const double p = x[0][a] + u[0][a], q = x[1][a] + u[1][a];
    out[0][a] = c * p - s * q - x[0][a], out[1][a] = s * p + c * q - x[1][a], out[2][a] = u[2][a];
  }
}

TEST(Hex64_StressedElement, FullTurnInTenThousandSteps_KeepsStressHistoryAndEnergy) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  Nodal x, u, v, f, first;
  for (int a = 0; a < hex_nodes; ++a) {
    const auto i = static_cast<std::size_t>(a);
    x[0][a] = 5e-3 * lobatto_node[i & 3], x[1][a] = 4e-3 * lobatto_node[i >> 2 & 3],
    x[2][a] = 2e-3 * lobatto_node[i >> 4];
    u[0][a] = 0.01 * x[0][a] + 0.6 * x[1][a] * x[2][a], u[1][a] = -0.004 * x[1][a] + 0.003 * x[2][a];
    u[2][a] = -0.005 * x[2][a] + 0.5 * x[0][a] * x[1][a];
  }
  const auto geometry = BoxGeometry::of_edges(10e-3, 8e-3, 4e-3);
  std::vector<double> history(hex_points * Law::fields, 0.0);
  for (std::size_t q = 0; q < hex_points; ++q) {
    history[q * Law::fields + Law::temperature_field] = 296.0;
    history[q * Law::fields + Law::static_stress_field] = 410e6;
  }
  hex_force<Law>(metal, geometry, {1e-6, true}, true, u, history.data(), first);
  const std::vector<double> committed = history;
  const double energy = hex_force<Law>(metal, geometry, {1e-6, true}, true, u, history.data(), first).elastic;
  double largest = 0.0, strain = 0.0;
  for (const auto& row : first)
    for (const double value : row) largest = std::max(largest, std::fabs(value));
  for (std::size_t q = 0; q < hex_points; ++q) strain = std::max(strain, history[q * Law::fields + Law::strain_field]);
  ASSERT_GT(strain, 5e-3);
  for (int i = 1; i <= 10000; ++i) {
    turned(x, u, 2.0 * M_PI * i / 10000.0, v);
    const auto sums = hex_force<Law>(metal, geometry, {1e-7, true}, true, v, history.data(), f);
    ASSERT_NEAR(sums.elastic / energy, 1.0, 1e-10) << "step " << i;
    const double c = std::cos(2.0 * M_PI * i / 10000.0), s = std::sin(2.0 * M_PI * i / 10000.0);
    ASSERT_NEAR(f[0][21], c * first[0][21] - s * first[1][21], 1e-10 * largest) << "N, step " << i;
  }
  for (std::size_t q = 0; q < committed.size(); ++q)
    EXPECT_NEAR(history[q], committed[q], 1e-12 * std::max(1.0, std::fabs(committed[q]))) << "field " << q;
}

}  // namespace
}  // namespace standoff::structure
