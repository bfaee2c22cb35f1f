// A case with [cell] and no [plate] is a unit cell of sand: read as one it needs the soil alone, read as a scene it is
// one mistake that names the verb. A scene read for its cell keeps its soil and forgets the rest. Exact.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

CaseOverrides for_purpose(CasePurpose purpose) {
  CaseOverrides overrides;
  overrides.purpose = purpose;
  return overrides;
}

constexpr const char* unit_cell = "[soil]\nkind = \"wet\"\n[cell]\nstrain = 0.09\ncells = 3\n";

TEST(CellCase, WithSoilAlone_IsComplete) {
  CaseFolder folder;
  folder.write("case.toml", unit_cell);
  for (const CasePurpose purpose : {CasePurpose::cell, CasePurpose::either}) {
    const CaseRead read = folder.read("case.toml", for_purpose(purpose));
    ASSERT_TRUE(read.errors.empty()) << all_errors(read);
    EXPECT_EQ(read.spec.soil.stiffness, 4e9);
    EXPECT_EQ(read.spec.soil.packing, 0.64);
    EXPECT_EQ(read.spec.cell.cells, 3);
    EXPECT_EQ(read.spec.cell.strain, 0.09);
    EXPECT_EQ(read.spec.cell.grains, 1000);
  }
}

TEST(CellCase, Resolved_GivesTheSameSpecificationAgain) {
  CaseFolder folder;
  folder.write("case.toml", unit_cell);
  const CaseRead first = folder.read("case.toml", for_purpose(CasePurpose::cell));
  folder.write("case.resolved.toml", first.resolved);
  const CaseRead again = folder.read("case.resolved.toml", for_purpose(CasePurpose::cell));
  ASSERT_TRUE(again.errors.empty()) << all_errors(again);
  EXPECT_EQ(again.hash, first.hash);
  EXPECT_EQ(again.spec.soil, first.spec.soil);
  EXPECT_EQ(again.spec.cell, first.spec.cell);
}

TEST(CellCase, ReadAsAScene_IsOneMistakeThatNamesTheVerb) {
  CaseFolder folder;
  folder.write("case.toml", unit_cell);
  const CaseRead read = folder.read("case.toml");
  ASSERT_EQ(read.errors.size(), 1u) << all_errors(read);
  EXPECT_THAT(read.errors[0], StartsWith("case.toml:3:2: error: this case is a unit cell"));
  EXPECT_THAT(read.errors[0], HasSubstr("standoff cell"));
}

TEST(CellCase, OfAScene_KeepsTheSoilAndForgetsTheRest) {
  CaseFolder folder;
  folder.write("case.toml", sound_case("[soil]\nkind = \"dry\"\ninner_radius = \"30 mm\"\nouter_radius = \"76.2 mm\"\n"
                                       "friction = 0.1\n[effects]\nheating = \"on\"\n"));
  const CaseRead read = folder.read("case.toml", for_purpose(CasePurpose::cell));
  ASSERT_TRUE(read.errors.empty()) << all_errors(read);
  EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  EXPECT_EQ(read.spec.soil.friction, 0.1);
  EXPECT_FALSE(read.spec.charge.present);
  EXPECT_THAT(read.resolved, testing::Not(HasSubstr("[plate")));
}

// Whether grains rub and turn is a matter of the soil; what melts a plate is not.
TEST(CellCase, OfAScene_KeepsTheEffectsOfItsSoil) {
  CaseFolder folder;
  const std::string soil = "[soil]\nkind = \"dry\"\ninner_radius = \"30 mm\"\nouter_radius = \"76.2 mm\"\n";
  folder.write("case.toml", sound_case(soil + "[effects]\nheating = \"on\"\ngrain_rotation = \"on\"\n"));
  const CaseRead turning = folder.read("case.toml", for_purpose(CasePurpose::cell));
  ASSERT_TRUE(turning.errors.empty()) << all_errors(turning);
  EXPECT_TRUE(turning.spec.effect("grain_rotation"));
  folder.write("case.resolved.toml", turning.resolved);
  EXPECT_TRUE(folder.read("case.resolved.toml", for_purpose(CasePurpose::cell)).spec.effect("grain_rotation"));
  folder.write("case.toml", sound_case(soil + "[effects]\nfriction = \"off\"\n"));
  const CaseRead smooth = folder.read("case.toml", for_purpose(CasePurpose::cell));
  EXPECT_EQ(smooth.spec.soil.friction, 0.0);
  EXPECT_FALSE(smooth.spec.effect("grain_rotation"));
}

TEST(CellCase, WithoutSand_IsAMistake) {
  CaseFolder folder;
  folder.write("case.toml", sound_case());
  const CaseRead read = folder.read("case.toml", for_purpose(CasePurpose::cell));
  ASSERT_EQ(read.errors.size(), 1u) << all_errors(read);
  EXPECT_THAT(read.errors[0], HasSubstr("there is no sand to test"));
}

}  // namespace
}  // namespace standoff::test
