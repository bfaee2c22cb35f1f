// Law: bodies cannot overlap, spheres cannot be packed denser than 0.74 (Kepler's bound, pi / sqrt(18) = 0.7405,
// rounded down), meshes must fit the mirror planes, times must not contradict each other. Each wrong scene gives
// exactly one error at the position of the value that made it wrong; scenes exactly on the bound are legal where the
// bound is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const char* const dry_shell = "[soil]\nkind = \"dry\"\ninner_radius = \"30 mm\"\nouter_radius = \"76.2 mm\"\n";

struct Mistake {
  const char* key;
  const char* value;
  const char* message;
};

/// One --set on a sound case with sand; "" if it stays sound.
std::string error_of(const char* key, const char* value) {
  CaseFolder folder;
  folder.write("case.toml", sound_case(dry_shell));
  const CaseRead result = folder.read("case.toml", with_set({{key, value}}));
  EXPECT_LE(result.errors.size(), 1u) << key << " = " << value << "\n" << all_errors(result);
  if (result.errors.empty()) return "";
  EXPECT_THAT(result.errors[0], StartsWith(std::string("--set ") + key + "=" + value + ": error: "));
  return result.errors[0];
}

TEST(SceneChecks, EachImpossibleScene_IsOneErrorAtTheValueThatMadeItSo) {
  const Mistake mistakes[] = {
      {"charge.radius", "31 mm", "the charge is larger than its cavity: radius 31 mm against inner_radius 30 mm"},
      {"charge.mass", "200 g", "the charge is larger than its cavity"},
      {"charge.radius", "15 mm", "the gas spheres do not fit into the charge: they would fill 1.33"},
      {"soil.inner_radius", "77 mm", "inner_radius 77 mm is not smaller than outer_radius 76.2 mm"},
      {"soil.packing", "0.75", "out of range; 0 < packing <= 0.74"},
      {"soil.grain_density", "0 kg/m3", "out of range; grain_density > 0 kg/m3"},
      {"soil.particles", "0", "out of range; 1 <= particles"},
      {"charge.explosive.fill", "-0.1", "out of range; 0 <= fill <= 0.74"},
      {"charge.explosive.fill", "0.75", "out of range; 0 <= fill <= 0.74"},
      {"charge.explosive.gamma", "1.7", "out of range; 1 < gamma <= 1.66667"},
      {"charge.detonator", "[0 m, 0 m, 0.2 m]",
       "the detonator is outside the charge: 50 mm from its centre, radius 28.17"},
      {"charge.detonator", "[1 mm, 0 m, 0.15 m]", "quarter symmetry needs the detonator on the z axis"},
      {"run.stand_off", "76 mm", "the sand overlaps the plate: stand_off 76 mm is smaller than its radius 76.2 mm"},
      {"run.until", "0 s", "out of range; until > 0 s"},
      {"run.until", "-1 ms", "out of range; until > 0 s"},
      {"run.until", "4 us", "interval 5 us is longer than the run, until = 4 us"},
      {"coupling.window", "0 s", "out of range; window > 0 s"},
      {"coupling.window", "3 ms", "window 3 ms is longer than the run, until = 2 ms"},
      {"plate.material.poissons_ratio", "0.5", "out of range; 0 <= poissons_ratio < 0.5"},
      {"plate.material.density", "-1 kg/m3", "out of range; density > 0 kg/m3"},
      {"plate.material.melting_temperature", "296 K", "melting_temperature 296 K is not above room_temperature 296 K"},
      {"plate.size", "[406 mm, 406 mm, 0 mm]", "size[2] = \"0 mm\" is out of range; size > 0 m"},
      {"plate.size", "[700 mm, 406 mm, 3 mm]", "the wall around the plate is smaller than the plate"},
      {"plate.elements", "[9, 10, 1]", "quarter symmetry needs even numbers of elements along x and y, not 9 and 10"},
      {"plate.elements", "[10, 10, 0]", "elements[2] = 0 is out of range"},
      {"domain.size", "[0.3 m, 1 m, 1 m]", "the domain is smaller than the scene: x from -150 mm to 150 mm, the plate"},
      {"domain.upper", "[1 m, 1 m, 0.2 m]",
       "the domain is smaller than the scene: it ends at z = 200 mm, the sand at z = 226.2 mm"},
      {"domain.lower", "[-1 m, -1 m, 0 m]", "the domain is smaller than the scene: it begins at z = 0 m"},
      {"soil.bulk_density", "0 kg/m3", "out of range; bulk_density > 0 kg/m3"},
      {"plate.model", "plate_hex644", "is not a choice here\n  did you mean \"plate_hex64\"?"}};
  for (const Mistake& mistake : mistakes)
    EXPECT_THAT(error_of(mistake.key, mistake.value), HasSubstr(mistake.message)) << mistake.key;
}

TEST(SceneChecks, WhatAModelCannotStandFor_IsOneErrorWithTheChoices) {
  struct {
    const char *model, *key, *value, *message;
  } const mistakes[] = {
      {"single_dof", "plate.edges", "symmetry",
       "single_dof does not know edges = \"symmetry\"\n  edges with this model: "},
      {"single_dof", "plate.edges", "free", "edges with this model: clamped|pinned; `standoff models`"},
      {"plate_shell", "plate.edges", "bolted", "plate_shell does not know edges = \"bolted\""},
      {"single_dof", "plate.size", "[406 mm, 400 mm, 3.4 mm]",
       "single_dof is a square plate, not one of 406 mm by 400 mm"},
      {"plate_shell", "plate.elements", "[10, 10, 2]", "a shell has one element through the thickness, not 2"}};
  for (const auto& mistake : mistakes) {
    CaseFolder folder;
    folder.write("case.toml", sound_case(dry_shell));
    const CaseRead result = folder.read(
        "case.toml",
        with_set({{"plate.model", mistake.model}, {"plate.opening", "300 mm"}, {mistake.key, mistake.value}}));
    ASSERT_EQ(result.errors.size(), 1u) << all_errors(result);
    EXPECT_THAT(result.errors[0], StartsWith(std::string("--set ") + mistake.key));
    EXPECT_THAT(result.errors[0], HasSubstr(mistake.message));
  }
}

TEST(SceneChecks, ScenesOnTheBound_AreLegal) {
  const std::pair<const char*, const char*> legal[] = {
      {"run.stand_off", "76.2 mm"},  // touching
      {"run.stand_off", "3 in"},     // the same length from another unit
      {"charge.radius", "30 mm"},    // fills its cavity
      {"soil.packing", "0.74"},          {"charge.explosive.gamma", "1.6666666666666667"},
      {"charge.detonator", "centre"},    {"coupling.window", "2 ms"},
      {"plate.elements", "[10, 12, 3]"}, {"domain.size", "[0.406 m, 0.406 m, 0.5 m]"}};
  for (const auto& [key, value] : legal) EXPECT_EQ(error_of(key, value), "");
}

TEST(SceneChecks, OddElementsAndOffAxisDetonator_AreLegalWithoutSymmetry) {
  CaseFolder folder;
  folder.write("case.toml", sound_case("symmetry = \"none\"\n"));
  const CaseRead result = folder.read(
      "case.toml", with_set({{"plate.elements", "[9, 9, 1]"}, {"charge.detonator", "[1 mm, 0 m, 0.15 m]"}}));
  EXPECT_EQ(all_errors(result), "");
}

TEST(SoilDensities, OneOfThemStated_TheOtherFollowsFromPacking) {
  CaseFolder folder;
  folder.write("case.toml", sound_case(dry_shell));
  const auto soil = [&](std::vector<std::pair<std::string, std::string>> set) {
    const CaseRead result = folder.read("case.toml", with_set(std::move(set)));
    EXPECT_EQ(all_errors(result), "");
    return result.spec.soil;
  };
  EXPECT_EQ(soil({{"soil.bulk_density", "1500 kg/m3"}}).grain_density, 1500.0 / 0.6);
  EXPECT_EQ(soil({{"soil.grain_density", "2500 kg/m3"}}).bulk_density, 0.6 * 2500.0);
  EXPECT_EQ(soil({{"soil.packing", "0.58"}}).bulk_density, 0.58 * 2700.0);                         // same grains
  EXPECT_EQ(soil({{"soil.kind", "wet"}, {"soil.packing", "0.62"}}).grain_density, 2020.0 / 0.62);  // same water
  const CaseRead both = folder.read("case.toml", with_set({{"soil.bulk_density", "1500 kg/m3"}, {"soil.kind", "wet"}}));
  EXPECT_EQ(both.spec.soil.grain_density, 1500.0 / 0.64);
  folder.write("case.toml", sound_case(dry_shell) + "bulk_density = \"1500 kg/m3\"\ngrain_density = \"2700 kg/m3\"\n");
  EXPECT_THAT(all_errors(folder.read()),
              HasSubstr("packing * grain_density = 1620 kg/m3, but bulk_density = 1500 kg/m3"));
}

}  // namespace
}  // namespace standoff::test
