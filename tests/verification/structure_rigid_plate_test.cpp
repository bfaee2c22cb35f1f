// A rigid plate with free edges is a free mass: W = F t^2 / 2M, V = F t / M, kinetic energy = work, to rounding, for a
// force held over the steps; held by its edges it does not move. Its surface answers a hit as the whole mass does: the
// mean over a quad of sum w_a^2 / m_a, bilinear weights w, is 1/M [(2/3)^2 (9/4) = 1].
#include <gtest/gtest.h>

#include "structure_solver/models/rigid_plate/rigid_plate.hpp"
#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure::testing {
namespace {

CaseSpec rigid_case(const char* edges) {
  CaseSpec spec = plate_case(4, true);
  spec.plate.model = "rigid_plate";
  spec.plate.edges = edges;
  return spec;
}

void press(RigidPlate& model, double newton, int steps, double dt) {
  const std::size_t nodes = model.surface().position.size();
  model.set_surface_force(std::vector<Vec3>(nodes, Vec3{0.1, 0.0, -newton / static_cast<double>(nodes)}));
  for (int i = 0; i < steps; ++i) model.step(dt);
}

TEST(RigidPlate, FreeUnderAConstantForce_FallsFreely) {
  RigidPlate model(rigid_case("free"));
  const double force = 5e4, dt = 0.7e-6, t = 200 * dt, mass = model.mass();
  press(model, force, 200, dt);
  const StructureLedger l = model.ledger();
  EXPECT_NEAR(model.centre_deflection() / (0.5 * force * t * t / mass), 1.0, 1e-12);
  EXPECT_NEAR(l.kinetic / l.external_work, 1.0, 1e-12);
  EXPECT_NEAR(l.momentum.z / (-force * t), 1.0, 1e-12);
  EXPECT_EQ(l.impulse_of_supports.z, 0.0);
  SurfaceMotion motion;
  model.surface_motion(motion);
  for (const Vec3& v : motion.velocity) EXPECT_NEAR(v.z / (-force * t / mass), 1.0, 1e-12);
}

TEST(RigidPlate, HeldByItsEdges_DoesNotMove) {
  RigidPlate model(rigid_case("clamped"));
  press(model, 5e4, 200, 0.7e-6);
  EXPECT_EQ(model.centre_deflection(), 0.0);
  EXPECT_EQ(model.ledger().external_work, 0.0);
  EXPECT_EQ(model.ledger().impulse_of_supports.z, -model.ledger().impulse_received.z);
}

TEST(RigidPlate, FreeSurface_AnswersAsTheWholeMass) {
  RigidPlate model(rigid_case("free"));
  for (const double m : model.surface().node_mass) EXPECT_NEAR(4.0 / 9.0 / m * model.mass(), 1.0, 1e-12);
}

}  // namespace
}  // namespace standoff::structure::testing
