// Law: preset < use < case < level < --set < option; among used files the later one, among nested ones the includer.
// Every resolved value tells its origin. Values are compared exactly: reading rounds once, as the literal does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Precedence, EachLayerStated_TheHigherOneCounts) {
  CaseFolder folder;
  folder.write("sand.toml", "[soil]\nkind = \"dry\"\nfriction = 0.2\nstiffness = \"0.2 GN/m\"\nparticles = 7\n");
  folder.write("case.toml",
               "[case]\nuse = [\"sand.toml\"]\n" +
                   sound_case("[soil]\ninner_radius = \"30 mm\"\nouter_radius = \"76.2 mm\"\nfriction = 0.1\n"
                              "[levels.coarse]\nsoil = 11\n[levels.fine]\nsoil = 13\n"));
  const CaseRead plain = folder.read();
  ASSERT_EQ(all_errors(plain), "");
  EXPECT_EQ(plain.spec.soil.packing, 0.60);     // preset
  EXPECT_EQ(plain.spec.soil.stiffness, 0.2e9);  // use over preset
  EXPECT_EQ(plain.spec.soil.friction, 0.1);     // case over use
  EXPECT_EQ(plain.spec.soil.particles, 11);     // level over use
  EXPECT_EQ(plain.spec.level, "coarse");
  EXPECT_THAT(plain.spec.levels, ElementsAre("coarse", "fine"));
  EXPECT_THAT(plain.resolved, HasSubstr("# preset dry"));
  EXPECT_THAT(plain.resolved, HasSubstr("# level coarse, "));

  CaseOverrides overrides = with_set({{"soil.particles", "17"}, {"soil.friction", "0.5"}, {"run.seed", "3"}});
  overrides.level = "fine";
  overrides.seed = "4";
  const CaseRead changed = folder.read("case.toml", overrides);
  ASSERT_EQ(all_errors(changed), "");
  EXPECT_EQ(changed.spec.level, "fine");
  EXPECT_EQ(changed.spec.soil.particles, 17);  // --set over level
  EXPECT_EQ(changed.spec.soil.friction, 0.5);  // --set over case
  EXPECT_EQ(changed.spec.run.seed, 4u);        // option over --set
}

TEST(Precedence, LaterAndOuterFiles_OverrideEarlierAndInnerOnes) {
  CaseFolder folder;
  folder.write("inner.toml", "[run]\nuntil = \"1 us\"\nseed = 1\n");
  folder.write("first.toml",
               "[case]\nuse = [\"inner.toml\"]\n[run]\nseed = 2\n[observe]\nsnapshots = 2\ninterval = \"1 us\"\n");
  folder.write("second.toml", "[observe]\nsnapshots = 3\n");
  folder.write("case.toml", "[case]\nuse = [\"first.toml\", \"second.toml\"]\n" + sound_case());
  const CaseRead result = folder.read();
  ASSERT_EQ(all_errors(result), "");
  EXPECT_EQ(result.spec.run.until, 1e-6);
  EXPECT_EQ(result.spec.run.seed, 2u);
  EXPECT_EQ(result.spec.observe.snapshots, 3);
}

TEST(Precedence, ValuesTypedOnACommandLine_NeedNoQuotes) {
  CaseFolder folder;
  folder.write("case.toml", sound_case());
  const CaseRead result = folder.read("case.toml", with_set({{"run.until", "2ms"},
                                                             {"plate.size", "[500 mm, 400 mm, 4 mm]"},
                                                             {"charge.detonator", "centre"},
                                                             {"run.symmetry", "none"},
                                                             {"run.settle", "false"},
                                                             {"coupling.window", "0.5 us"},
                                                             {"charge.explosive", "c4_paper"},
                                                             {"charge.explosive.gamma", "1.3"},
                                                             {"effects.heating", "off"},
                                                             {"case.title", "12"},
                                                             {"plate.elements", "[4,6,2]"}}));
  ASSERT_EQ(all_errors(result), "");
  EXPECT_EQ(result.spec.run.until, 2e-3);
  EXPECT_EQ(result.spec.plate.size, (Vec3{0.5, 0.4, 0.004}));
  EXPECT_EQ(result.spec.charge.detonator, (Vec3{0.0, 0.0, 0.15}));
  EXPECT_FALSE(result.spec.run.quarter_symmetry);
  EXPECT_FALSE(result.spec.effect("symmetry"));
  EXPECT_FALSE(result.spec.effect("relaxation"));
  EXPECT_EQ(result.spec.coupling.window, 0.5e-6);
  EXPECT_EQ(result.spec.coupling.window_rule, CouplingSpec::Window::fixed);
  EXPECT_EQ(result.spec.charge.explosive.fill, 0.35);
  EXPECT_EQ(result.spec.charge.explosive.gamma, 1.3);
  EXPECT_FALSE(result.spec.effect("heating"));
  EXPECT_EQ(result.spec.title, "12");
  EXPECT_EQ(result.spec.plate.elements, (std::array<int, 3>{4, 6, 2}));
}

TEST(Precedence, PresetNamedLater_ReplacesAWholeTable) {
  CaseFolder folder;
  folder.write("own.toml", "[charge]\nexplosive = { preset = \"c4\", fill = 0.3, energy = \"5 GJ/m3\" }\n");
  folder.write("case.toml", "[case]\nuse = [\"own.toml\"]\n" + sound_case());
  EXPECT_EQ(folder.read().spec.charge.explosive.energy, 5e9);
  EXPECT_EQ(folder.read().spec.charge.explosive.density, 1601.0);
  const CaseRead replaced = folder.read("case.toml", with_set({{"charge.explosive", "c4_paper"}}));
  ASSERT_EQ(all_errors(replaced), "");
  EXPECT_EQ(replaced.spec.charge.explosive.energy, 8.7e9);
  EXPECT_EQ(replaced.spec.charge.explosive.fill, 0.35);
}

TEST(Includes, FileInTheFolderOfAllCases_IsFoundFromBelow) {
  CaseFolder folder;
  folder.write("cases/common/until.toml", "[run]\nuntil = \"3 ms\"\n");
  folder.write("cases/group/one/case.toml", "[case]\nuse = [\"common/until.toml\"]\n" + sound_case());
  const CaseRead result = folder.read("cases/group/one");
  ASSERT_EQ(all_errors(result), "");
  EXPECT_EQ(result.spec.run.until, 3e-3);
  EXPECT_EQ(result.spec.name, "one");
}

TEST(Includes, CircleOfFiles_IsNamedAndEnds) {
  CaseFolder folder;
  folder.write("a.toml", "[case]\nuse = [\"b.toml\"]\n").write("b.toml", "[case]\nuse = [\"a.toml\"]\n");
  folder.write("case.toml", "[case]\nuse = [\"a.toml\", \"missing.toml\"]\n" + sound_case());
  const CaseRead result = folder.read();
  ASSERT_EQ(result.errors.size(), 2u) << all_errors(result);
  EXPECT_EQ(result.errors[0], "b.toml:2:8: error: use: \"a.toml\" uses itself\n  a.toml -> b.toml -> a.toml");
  EXPECT_THAT(result.errors[1],
              HasSubstr("case.toml:2:18: error: use: there is no file \"missing.toml\"\n  looked for "));
}

}  // namespace
}  // namespace standoff::test
