// A plate material that cannot be is an error at its own line and column; every law is read as it is written, and the
// resolved case says the same again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::HasSubstr;

const char* const base =
    "[plate]\nsize = [\"406 mm\", \"406 mm\", \"3.4 mm\"]\n[plate.material]\ndensity = \"8060 kg/m3\"\n"
    "youngs_modulus = \"195 GPa\"\npoissons_ratio = 0.3\n";  // lines 1 to 6

struct Bad {
  const char* lines;  // from line 7 on
  const char* place;
  const char* message;
};

TEST(PlateMaterial_BadConstants, EachAlone_IsOneErrorAtItsPosition) {
  const Bad cases[] = {
      {"A = \"-1 MPa\"\n", "case.toml:7:", "A = \"-1 MPa\" is out of range"},
      {"A = \"410 MPa\"\nmelting_temperature = \"280 K\"\n", "case.toml:8:", "is not above room_temperature"},
      {"A = \"410 MPa\"\ntaylor_quinney = 1.2\n", "case.toml:8:", "out of range"},
      {"law = \"johnson_cok\"\nA = \"410 MPa\"\n", "case.toml:7:", "did you mean \"johnson_cook\""},
      {"law = \"johnson_cook\"\n", "case.toml:", "A is missing in [plate.material]"},
      {"law = \"j2_table\"\nplastic_strain = [0, 0.1]\n", "case.toml:", "flow_stress is missing"},
      {"law = \"j2_table\"\nplastic_strain = [0, 0.1, 0.1]\nflow_stress = [\"400 MPa\", \"500 MPa\", \"600 MPa\"]\n",
       "case.toml:8:", "do not rise"},
      {"law = \"j2_table\"\nplastic_strain = [0, 0.1]\nflow_stress = [\"400 MPa\", \"300 MPa\"]\n",
       "case.toml:9:", "falls somewhere"},
      {"law = \"j2_table\"\nplastic_strain = [0, 0.1]\nflow_stress = [\"400 MPa\"]\n",
       "case.toml:", "2 plastic strains"},
      {"law = \"j2_table\"\nplastic_strain = [0.01, 0.1]\nflow_stress = [\"400 MPa\", \"500 MPa\"]\n",
       "case.toml:8:", "starts at plastic strain 0.01"},
      {"law = \"j2_table\"\nplastic_strain = [0, 0.1]\nflow_stress = [\"400 MPa\", \"-5 MPa\"]\n",
       "case.toml:9:", "flow_stress[1] = \"-5 MPa\" is out of range"},
      {"law = \"j2_table\"\nplastic_strain = [0, 0.1]\nflow_stress = [\"400 MPa\", 500]\n",
       "case.toml:9:", "has no unit"}};
  for (const Bad& bad : cases) {
    CaseFolder folder;
    folder.write("case.toml", std::string(base) + bad.lines);
    const CaseRead result = folder.read();
    ASSERT_EQ(result.errors.size(), 1u) << bad.lines << all_errors(result);
    EXPECT_THAT(result.errors[0], HasSubstr(bad.place)) << bad.lines;
    EXPECT_THAT(result.errors[0], HasSubstr(bad.message)) << bad.lines;
  }
}

TEST(PlateMaterial_ElasticConstants, OutOfRange_AreErrorsAtTheirPositions) {
  for (const auto& [key, value] : {std::pair{"plate.material.poissons_ratio", "0.5"},
                                   {"plate.material.density", "0 kg/m3"},
                                   {"plate.material.youngs_modulus", "-1 GPa"}}) {
    CaseFolder folder;
    folder.write("case.toml", sound_case());
    const CaseRead result = folder.read("case.toml", with_set({{key, value}}));
    ASSERT_EQ(result.errors.size(), 1u) << key << all_errors(result);
    EXPECT_THAT(result.errors[0], HasSubstr(std::string("--set ") + key)) << all_errors(result);
  }
}

TEST(PlateMaterial_Table, Read_KeepsItsPointsAlsoThroughTheResolvedCase) {
  CaseFolder folder;
  folder.write("case.toml", std::string(base) +
                                "law = \"j2_table\"\nplastic_strain = [0, 0.05, 0.2]\n"
                                "flow_stress = [\"400 MPa\", \"0.5 GPa\", \"600 MPa\"]\n");
  const CaseRead first = folder.read();
  ASSERT_TRUE(first.errors.empty()) << all_errors(first);
  const MaterialSpec& m = first.spec.plate.material;
  EXPECT_EQ(m.law, MaterialLaw::j2_table);
  EXPECT_EQ(m.plastic_strain, (std::vector<double>{0.0, 0.05, 0.2}));
  EXPECT_EQ(m.flow_stress, (std::vector<double>{400e6, 500e6, 600e6}));
  EXPECT_EQ(m.A, 400e6) << "Pa: the first point is the yield stress";
  folder.write("again.toml", first.resolved);
  const CaseRead again = folder.read("again.toml");
  ASSERT_TRUE(again.errors.empty()) << all_errors(again);
  EXPECT_EQ(again.spec.plate, first.spec.plate);
  EXPECT_EQ(again.hash, first.hash);
}

TEST(PlateMaterial_Elastic, NeedsNoYieldStress_AndNothingThatFlowBrings) {
  CaseFolder folder;
  folder.write("case.toml", std::string(base) + "law = \"elastic\"\n");
  const CaseRead result = folder.read();
  ASSERT_TRUE(result.errors.empty()) << all_errors(result);
  for (const char* name : {"plasticity", "hardening", "strain_rate", "heating", "expansion"})
    EXPECT_FALSE(result.spec.effect(name)) << name;
}

// An override of plasticity takes along what only flow brings.
TEST(PlateMaterial_PlasticityOff, ByOverride_TakesHeatAndHardeningAlong) {
  CaseFolder folder;
  folder.write("case.toml", sound_case("[effects]\nplasticity = \"off\"\n"));
  const CaseRead result = folder.read();
  ASSERT_TRUE(result.errors.empty()) << all_errors(result);
  for (const char* name : {"plasticity", "hardening", "strain_rate", "heating"})
    EXPECT_FALSE(result.spec.effect(name)) << name;
}

TEST(PlateMaterial_Copper, Preset_IsTheOriginalLaw) {
  CaseFolder folder;
  folder.write("case.toml", sound_case());
  const CaseRead result = folder.read("case.toml", with_set({{"plate.material", "ofhc_copper"}}));
  ASSERT_TRUE(result.errors.empty()) << all_errors(result);
  EXPECT_EQ(result.spec.plate.material.law, MaterialLaw::johnson_cook_log);
  EXPECT_EQ(result.spec.plate.material.B, 292e6);
  EXPECT_EQ(result.spec.plate.material.melting_temperature, 1356.0);
}

}  // namespace
}  // namespace standoff::test
