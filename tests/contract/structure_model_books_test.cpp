// The books of every structural model: impulse in is momentum gained plus supports (rounding, 1e-12); the energy of a
// smooth elastic pulse closes (central differences, second order: 1e-3 of the work); steps at the stable step stay
// bounded; nothing happens without a load; a model without supports flies on.
#include "tests/contract/structure_model_suite.hpp"

namespace standoff::structure::testing {
namespace {

class StructureModelBooks : public StructureModel {};

TEST_P(StructureModelBooks, Momentum_UnderUnevenHits_IsReceivedPlusSupports) {
  for (const bool quarter : symmetries(GetParam())) {
    const auto model = make_structural_model(model_case(GetParam(), quarter), 1);
    Hammer{}.strike(*model, 300);
    const StructureLedger l = model->ledger();
    const double scale = norm(l.momentum) + norm(l.impulse_received) + norm(l.impulse_of_supports);
    ASSERT_GT(norm(l.impulse_received), 0.0);
    ASSERT_GT(norm(l.impulse_of_supports), 1e-5 * scale);
    EXPECT_LT(norm(l.momentum - l.impulse_received - l.impulse_of_supports), 1e-12 * scale) << "N s";
  }
}

TEST_P(StructureModelBooks, Energy_UnderASmoothElasticPulse_Closes) {
  CaseSpec spec = model_case(GetParam());
  spec.plate.material.A = 1e12;
  const auto model = make_structural_model(spec, 1);
  const double duration = 60e-6;
  double peak = 0.0, worst = 0.0;
  while (model->time() < 2.0 * duration) {
    const double phase = model->time() / duration;
    model->set_surface_force(
        pressure_on(model->surface(), phase < 1.0 ? 4e6 * std::pow(std::sin(M_PI * phase), 2) : 0.0));
    const double dt = std::min(model->stable_step(), 0.02 * duration);
    for (int i = 0; i < 5; ++i) model->step(dt);
    peak = std::max(peak, model->ledger().external_work);
    worst = std::max(worst, std::fabs(model->ledger().balance()));
  }
  if (model->elements() > 0) {
    ASSERT_GT(peak, 1.0) << "J";
  }
  EXPECT_LE(worst, 1e-3 * peak) << "J of " << peak;
}

// An unstable step grows by a factor in every step and would pass any bound within a thousand.
TEST_P(StructureModelBooks, StableStep_AThousandTimes_StaysBoundedAndItsLedgerCloses) {
  const auto model = make_structural_model(model_case(GetParam()), 1);
  model->set_surface_force(pressure_on(model->surface(), 1e6));
  double work = 0.0;
  for (int i = 0; i < 1000; ++i) {
    model->step(model->stable_step());
    work = std::max(work, model->ledger().external_work);
  }
  const StructureLedger l = model->ledger();
  EXPECT_TRUE(std::isfinite(l.kinetic) && l.kinetic <= 2.0 * work) << l.kinetic << " J";
  EXPECT_LE(std::fabs(l.balance()), 2e-3 * work) << "J";
  EXPECT_LT(std::fabs(model->centre_deflection()), 0.05) << "m";
}

TEST_P(StructureModelBooks, NoLoad_ManySteps_LeavesEveryBit) {
  const auto model = make_structural_model(model_case(GetParam()), 1);
  const std::uint64_t before = hash_of(*model);
  model->set_surface_force(std::vector<Vec3>(model->surface().position.size()));
  for (int i = 0; i < 500; ++i) model->step(model->stable_step());
  EXPECT_EQ(hash_of(*model), before);
  EXPECT_EQ(model->ledger().balance(), 0.0);
  EXPECT_EQ(model->centre_deflection(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Registry, StructureModelBooks, ::testing::ValuesIn(structural_model_names()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace standoff::structure::testing
