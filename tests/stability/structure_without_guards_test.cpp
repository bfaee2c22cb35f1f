// What the guards of the plate see and nothing else would.
#include <cmath>

#include <gtest/gtest.h>

#include "structure_solver/relaxation/rest_monitor.hpp"
#include "structure_solver/step/hex_force.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

// An element turned inside out, F = diag(1, 1, -1): its strain is 1/2 ln F F^T = 0, so that energy and force vanish to
// rounding (2e-16 in F F^T - I, times K and the volume or an area) and any book closes. Its volume is -1 times what it
// was: only det F tells.
TEST(InsideOut_WithoutGuard, MirroredElement_IsFreeOfStressAndHasNegativeVolume) {
  const MetalParameters metal = metal_parameters(testing::al6xn());
  const auto geometry = BoxGeometry::of_edges(10e-3, 8e-3, 4e-3);
  double* const none = nullptr;  // elastic: no history
  double u[3][hex_nodes]{}, force[3][hex_nodes];
  for (int a = 0; a < hex_nodes; ++a) u[2][a] = -4e-3 * lobatto_node[static_cast<std::size_t>(a) >> 4];
  const ElementSums<double> sums = hex_force<Elastic>(metal, geometry, {1e-7, true}, true, u, none, force);
  const double volume = 10e-3 * 8e-3 * 4e-3, face = 10e-3 * 8e-3;
  EXPECT_LT(std::abs(sums.elastic), 1e-12 * metal.bulk * volume) << "J; 1e-3 of strain would be 1e-6";
  for (const auto& component : force)
    for (const double f : component) EXPECT_LT(std::abs(f), 1e-12 * metal.bulk * face) << "N";
  EXPECT_FALSE(sums.sound) << "what the guard asks";
}

// A plate let go from 1 mm has no kinetic energy: by that alone it rests there. Within one period of the clamped plate,
// 176 Hz, it has been near -1 mm. The unbalanced force says so at once, the drift after that period. (1 + cos)(1 + cos)
// is not quite the first mode, and other modes have other phases by then: a tenth for them.
TEST(Rest_KineticEnergyAlone, PlateLetGoFromOneMillimetre_WouldRestWhereItIs) {
  CaseSpec spec = testing::plate_case(4, true);
  spec.plate.material.law = MaterialLaw::elastic;
  PlateHex64 model(spec, 1);
  RelaxationProblem& plate = *model.relaxation();
  const PlateMesh& mesh = model.plate().mesh();
  const auto along = [](double x, double size) { return 0.5 * (1.0 + std::cos(2.0 * M_PI * x / size)); };
  std::vector<double> u, f(static_cast<std::size_t>(plate.dofs()));
  for (std::size_t i = 0; i < mesh.node_count(); ++i) {
    const Vec3& x = mesh.position[i];
    if ((mesh.fixed[i] & fixed_x) == 0) u.push_back(0.0);
    if ((mesh.fixed[i] & fixed_y) == 0) u.push_back(0.0);
    if ((mesh.fixed[i] & fixed_z) == 0) u.push_back(-1e-3 * along(x.x, 0.406) * along(x.y, 0.406));
  }
  plate.set_state(u, std::vector<double>(u.size(), 0.0));
  ASSERT_NEAR(model.centre_deflection(), 1e-3, 1e-9) << "m";
  EXPECT_EQ(model.ledger().kinetic, 0.0) << "J: below any share of any peak";
  ASSERT_TRUE(plate.internal_force(u, 0.0, f));
  double unbalanced = 0.0;
  for (const double value : f) unbalanced = std::max(unbalanced, std::abs(value));
  EXPECT_GT(unbalanced, RestLimits{}.residual) << "N";
  double lowest = 1e-3;
  while (model.time() < 1.0 / 176.0) {
    model.step(model.stable_step());
    lowest = std::min(lowest, model.centre_deflection());
  }
  EXPECT_LT(lowest, -0.9e-3) << "m: the plate was nowhere near its rest";
}

}  // namespace
}  // namespace standoff::structure
