// Scaling laws of the prediction (formulas and sources in coupling/launcher/prediction.hpp). Ratios of closed forms:
// tolerances are rounding where steps are not counted, and one count in N where they are.
#include <cmath>

#include <gtest/gtest.h>

#include "coupling/case/structural_models.hpp"
#include "coupling/launcher/prediction.hpp"

namespace standoff::launch {
namespace {

CaseSpec sand_case(long charge, long sand, int elements) {
  CaseSpec spec;
  spec.charge = {true, {"c4", 1601.0, 8.7e9, 1.4, 0.2, 8190.0}, 0.15, 0.0282, 0.0, {}, charge};
  spec.soil.kind = SoilKind::dry, spec.soil.inner_radius = 0.03, spec.soil.outer_radius = 0.0762;
  spec.soil.packing = 0.6, spec.soil.grain_density = 2700.0, spec.soil.bulk_density = 1620.0;
  spec.soil.stiffness = 0.4e9, spec.soil.friction = 0.3, spec.soil.particles = sand;
  spec.plate.material.density = 8060.0, spec.plate.material.youngs_modulus = 195e9,
  spec.plate.material.poissons_ratio = 0.3;
  spec.plate.size = {0.406, 0.406, 3.4e-3};
  spec.plate.elements = {elements, elements, 1};
  spec.run.stand_off = 0.15, spec.run.until = 2e-3;
  spec.coupling.window_rule = CouplingSpec::Window::fixed, spec.coupling.window = 0.2e-6;
  spec.effects = {
      {"friction", true, "mu = 0.3", false}, {"damping", false, "xi = 0", false}, {"relaxation", true, "", false}};
  return spec;
}

TEST(Prediction, StructureStep_IsTheMeasuredOneOfThePlate) {
  // 0.1335 us for 64-node hexahedra of 3.4 mm thickness: an eigenvalue of the reference system; within 1 %.
  const CostPrediction p = predict_cost(sand_case(10000, 50000, 10), 2);
  EXPECT_NEAR(p.structure_step / CostConstants{}.structure_safety, 0.1335e-6, 0.01 * 0.1335e-6);
}

// Price and memory go with the chosen model, in the ratios of its table. A window of 50 us takes some eighty steps of
// the longest; counting them in whole steps is off by one in eighty.
TEST(Prediction, ChosenModel_IsPricedByItsOwnCostStepAndPoints) {
  CaseSpec spec = sand_case(10000, 50000, 10);
  spec.coupling.window_rule = CouplingSpec::Window::fixed, spec.coupling.window = 50e-6;
  const CostPrediction cubic = predict_cost(spec, 2);
  for (const StructuralModelEntry& model : structural_models) {
    if (model.name == material_point_model) continue;
    spec.plate.model = model.name;
    const CostPrediction p = predict_cost(spec, 2);
    EXPECT_NEAR(p.structure_step / cubic.structure_step, model.relative_step, 1e-12) << model.name;
    EXPECT_NEAR(p.structure_s / cubic.structure_s, model.relative_cost, 0.015 * model.relative_cost) << model.name;
    EXPECT_NEAR(p.structure_bytes / cubic.structure_bytes, model.points / 64.0, 1e-12) << model.name;
    EXPECT_GT(p.structure_s, 0.0) << model.name;
  }
}

TEST(Prediction, EightTimesTheGrains_HalveTheSandStep) {
  // m ~ 1/N and k ~ N^(-1/3): step ~ sqrt(m/k) ~ N^(-1/3).
  CaseSpec few = sand_case(10000, 400000, 10), many = sand_case(10000, 3200000, 10);
  few.coupling.window = many.coupling.window = 1e-5;  // longer than any step
  EXPECT_NEAR(predict_cost(many, 2).sand_step / predict_cost(few, 2).sand_step, 0.5, 1e-12);
}

TEST(Prediction, QuarterModel_ComputesAQuarterOfTheParticles) {
  CaseSpec spec = sand_case(10000, 50000, 10);
  const CostPrediction quarter = predict_cost(spec, 2);
  spec.run.quarter_symmetry = false;
  const CostPrediction full = predict_cost(spec, 2);
  EXPECT_DOUBLE_EQ(full.sand_s, 4.0 * quarter.sand_s);
  EXPECT_DOUBLE_EQ(full.gas_s, 4.0 * quarter.gas_s);
  EXPECT_DOUBLE_EQ(full.structure_s, 4.0 * quarter.structure_s);
}

TEST(Prediction, EffectThatIsOff_HasNoPrice) {
  const CostPrediction p = predict_cost(sand_case(10000, 50000, 10), 2);
  EXPECT_GT(p.effects[0].bytes, 0.0);
  EXPECT_GT(p.effects[0].seconds, 0.0);
  EXPECT_EQ(p.effects[1].bytes, 0.0);
  EXPECT_EQ(p.effects[1].seconds, 0.0);
}

TEST(Prediction, EffectsInTheParticles_CostInProportionToThem) {
  CaseSpec spec = sand_case(10000, 50000, 10);
  spec.effects = {
      {"hard_core", true, "", false}, {"surface_recession", true, "", false}, {"grain_rotation", true, "", false}};
  const CostPrediction quarter = predict_cost(spec, 2);
  spec.run.quarter_symmetry = false;
  const CostPrediction full = predict_cost(spec, 2);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GT(quarter.effects[k].seconds, 0.0) << quarter.effects[k].name;
    EXPECT_LT(quarter.effects[k].seconds, 0.1 * (quarter.gas_s + quarter.sand_s)) << quarter.effects[k].name;
    EXPECT_DOUBLE_EQ(full.effects[k].seconds, 4.0 * quarter.effects[k].seconds) << quarter.effects[k].name;
  }
  spec.effects[2].on = false;
  const CostPrediction off = predict_cost(spec, 2);
  EXPECT_EQ(off.effects[2].seconds, 0.0);
  ASSERT_TRUE(off.effects[2].overriding.has_value());
  EXPECT_DOUBLE_EQ(off.effects[2].overriding->seconds, full.effects[2].seconds) << "what turning it on would cost";
}

// The price of grains that move and do not turn is measured without turning: with it their seconds and bytes grow by
// the price of the effect, and so does the clock on the wall of one core. A measured price: 10 ns a grain and step.
TEST(Prediction, GrainsThatTurn_TakeTheirPriceMoreThanThoseThatDoNot) {
  CaseSpec spec = sand_case(10000, 50000, 10);
  spec.effects = {{"grain_rotation", true, "", false}};
  const CostPrediction turning = predict_cost(spec, 1);
  spec.effects[0].on = false;
  const CostPrediction off = predict_cost(spec, 1);
  EXPECT_DOUBLE_EQ(turning.effects[0].seconds, off.sand_steps * off.simulated(50000) * 10e-9);
  const double rounding =
      1e-12 * turning.wall_s;  // sums of fewer than ten terms round to 1e-15 of them; a thousand times that
  EXPECT_NEAR(turning.sand_s - off.sand_s, turning.effects[0].seconds, rounding);
  EXPECT_NEAR(turning.core_s() - off.core_s(), turning.effects[0].seconds, rounding);
  EXPECT_NEAR(turning.wall_s - off.wall_s, turning.effects[0].seconds, rounding);
  EXPECT_DOUBLE_EQ(turning.particle_bytes - off.particle_bytes, turning.effects[0].bytes);
}

TEST(Prediction, SceneWithoutSand_HasNoSandRow) {
  CaseSpec spec = sand_case(10000, 50000, 10);
  spec.soil.kind = SoilKind::none;
  const CostPrediction p = predict_cost(spec, 2);
  EXPECT_EQ(p.sand_particles, 0);
  EXPECT_EQ(p.sand_s + p.packing_s, 0.0);
}

TEST(Prediction, AutomaticWindow_IsThatOfThePlateOrOfSmallParticles) {
  const auto window = [](long charge, long sand) {
    CaseSpec spec = sand_case(charge, sand, 10);
    spec.coupling.window_rule = CouplingSpec::Window::automatic;
    return predict_cost(spec, 2).window;
  };
  EXPECT_EQ(window(1000, 5000), window(8000, 40000));  // a wave through the thickness and back
  EXPECT_NEAR(window(80000000, 400000000) / window(10000000, 50000000), 0.5, 1e-12);  // radius ~ N^(-1/3)
}

TEST(Prediction, Threads_NeverExceedTheCoresInSum_NorFallBelowOne) {
  for (int cores = 1; cores <= 16; ++cores)
    for (const int elements : {4, 10, 40}) {
      const CostPrediction p = predict_cost(sand_case(10000, 50000, elements), cores);
      EXPECT_GE(p.particle_threads, 1);
      EXPECT_GE(p.structure_threads, 1);
      EXPECT_LE(p.particle_threads + p.structure_threads, cores + 1) << cores << " cores";
    }
}

TEST(Prediction, NothingToCompute_IsFinite) {
  CaseSpec spec = sand_case(10000, 50000, 10);
  spec.charge.present = false, spec.soil.kind = SoilKind::none;
  EXPECT_TRUE(std::isfinite(predict_cost(spec, 2).wall_s));
  spec = sand_case(10000, 50000, 10);
  spec.charge.explosive.fill = 0.0;
  spec.coupling.window_rule = CouplingSpec::Window::automatic;
  EXPECT_TRUE(std::isfinite(predict_cost(spec, 2).wall_s));
}

}  // namespace
}  // namespace standoff::launch
