// One list of models: the solver builds exactly those that the case reader accepts and `standoff models` tells of;
// only the material point is no structure before a charge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/case/structural_models.hpp"
#include "tests/contract/structure_model_suite.hpp"

namespace standoff::structure {
namespace {

TEST(StructureRegistry, Names_AreThoseOfTheCaseReader) {
  std::vector<std::string> told;
  for (const StructuralModelEntry& model : structural_models)
    if (model.name != material_point_model) told.emplace_back(model.name);
  EXPECT_THAT(structural_model_names(), ::testing::UnorderedElementsAreArray(told));
}

// The step that `standoff plan` expects of a model is the mean of a run, in windows that a whole number of steps fills:
// five of plate_hex64. It is no longer than what is stable on the mesh of the reference, and at least half of it; the
// steps of two models do not shrink quite alike as the plate thins, by 5 % at most.
TEST(StructureRegistry, StepsThatThePlanExpects_AreStable) {
  CaseSpec plate = testing::plate_case(10, true);
  const double cubic = make_structural_model(plate, 1)->stable_step();
  for (const StructuralModelEntry& model : structural_models) {
    if (model.name == material_point_model) continue;
    CaseSpec spec = testing::model_case(std::string(model.name));
    spec.plate.elements = spec.plate.is_pipe() ? std::array{20, 5, 1} : plate.plate.elements;
    const double stable = make_structural_model(spec, 1)->stable_step() / cubic;
    EXPECT_LE(model.relative_step, 1.05 * stable) << model.name;
    EXPECT_GE(model.relative_step, 0.5 * stable) << model.name;
  }
}

}  // namespace
}  // namespace standoff::structure
