// One list of models: the solver builds exactly those that the case reader accepts and `standoff models` tells of;
// only the material point is no structure before a charge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/case/structural_models.hpp"
#include "structure_solver/models/structural_model.hpp"

namespace standoff::structure {
namespace {

TEST(StructureRegistry, Names_AreThoseOfTheCaseReader) {
  std::vector<std::string> told;
  for (const StructuralModelEntry& model : structural_models)
    if (model.name != material_point_model) told.emplace_back(model.name);
  EXPECT_THAT(structural_model_names(), ::testing::UnorderedElementsAreArray(told));
}

}  // namespace
}  // namespace standoff::structure
