// What every structural model shows the other side of the interface: a sane surface, masses, and an adjoint map.
// Law of the map: x_s = N x and f = N^T f_s make the work of the surface force over its way equal to the work on the
// degrees of freedom. Positions carry 1e-17 m and ways 1e-7 m: the sum of both agrees to 1e-9.
#include "tests/contract/structure_model_suite.hpp"

namespace standoff::structure::testing {
namespace {

TEST_P(StructureModel, Surface_AtRest_IsSaneAndLooksAtTheCharge) {
  for (const bool quarter : symmetries(GetParam())) {
    const CaseSpec spec = model_case(GetParam(), quarter);
    const auto model = make_structural_model(spec, 1);
    const SurfaceMesh& s = model->surface();
    ASSERT_EQ(s.node_mass.size(), s.position.size());
    std::vector<int> used(s.position.size());
    double area = 0.0;
    for (const auto& q : s.quads) {
      for (const std::int32_t node : q) {
        ASSERT_GE(node, 0);
        ASSERT_LT(static_cast<std::size_t>(node), s.position.size());
        ++used[static_cast<std::size_t>(node)];
      }
      const auto at = [&](std::size_t i) { return s.position[static_cast<std::size_t>(q[i])]; };
      const Vec3 whole = 0.5 * cross(at(2) - at(0), at(3) - at(1));
      EXPECT_GT(dot(whole, inwards(spec, 0.25 * (at(0) + at(1) + at(2) + at(3)))), 0.99 * norm(whole))
          << "a normal towards the charge";
      area += norm(whole);
    }
    for (const int n : used) EXPECT_GT(n, 0) << "a node of no quad";
    EXPECT_NEAR(area / loaded_area(spec), 1.0, spec.plate.is_pipe() ? 1e-5 : 1e-12);  // between nodes of its circle
    for (const double m : s.node_mass) EXPECT_GT(m, 0.0) << "kg";
    SurfaceMotion motion;
    model->surface_motion(motion);
    EXPECT_EQ(motion.position, s.position);
    EXPECT_EQ(motion.velocity, std::vector<Vec3>(s.position.size()));
  }
}

TEST_P(StructureModel, Mass_OfTheSimulatedPart_IsDensityTimesVolume) {
  for (const bool quarter : symmetries(GetParam())) {
    const auto model = make_structural_model(model_case(GetParam(), quarter), 1);
    const double expected = 8060.0 * 0.406 * 0.406 * 0.0034 / (quarter ? 4.0 : 1.0);
    EXPECT_NEAR(model->mass() / expected, 1.0, 1e-12) << "kg";
  }
}

TEST_P(StructureModel, Map_OverManySteps_GivesTheWorkOfTheSurfaceForce) {
  const auto model = make_structural_model(model_case(GetParam()), 1);
  std::vector<Vec3> force = pressure_on(model->surface(), 3e6);
  for (std::size_t i = 0; i < force.size(); ++i) force[i] = (1.0 + 0.5 * std::sin(1.7 * double(i))) * force[i];
  model->set_surface_force(force);
  SurfaceMotion before, after;
  double work = 0.0, scale = 0.0;
  for (int i = 0; i < 50; ++i) {
    model->surface_motion(before);
    model->step(model->stable_step());
    model->surface_motion(after);
    for (std::size_t n = 0; n < force.size(); ++n) {
      const double part = dot(force[n], after.position[n] - before.position[n]);
      work += part, scale += std::fabs(part);
    }
  }
  EXPECT_NEAR(work, model->ledger().external_work, 1e-9 * scale) << "J";
}

INSTANTIATE_TEST_SUITE_P(Registry, StructureModel, ::testing::ValuesIn(structural_model_names()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace standoff::structure::testing
