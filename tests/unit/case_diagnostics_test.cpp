// Law: every mistake of a case is reported in one reading, each as path:line:column of the offending key or value (both
// counted from 1, as editors do), with what is wrong and how to fix it; nothing is reported twice or as a consequence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(Diagnostics, FourDifferentMistakes_AreAllReportedWithTheirPositions) {
  CaseFolder folder;
  folder.write("case.toml",
               "[case]\n"                                // 1
               "title = \"four mistakes\"\n"             // 2
               "[charge]\n"                              // 3
               "mass = \"150 g\"\n"                      // 4
               "[plate]\n"                               // 5
               "  materal = \"al6xn\"\n"                 // 6: unknown key
               "material = \"al6xn\"\n"                  // 7
               "size = [\"406 mm\", 406, \"3.4 mm\"]\n"  // 8: bare number
               "[run]\n"                                 // 9
               "stand_off = \"150 kg\"\n"                // 10: wrong dimension
               "[soil]\n"                                // 11
               "kind = \"dry\"\n"                        // 12
               "inner_radius = \"80 mm\"\n"              // 13: larger than the outer radius
               "outer_radius = \"76.2 mm\"\n");          // 14
  const CaseRead result = folder.read();
  EXPECT_THAT(
      result.errors,
      ElementsAre("case.toml:6:3: error: unknown key \"materal\" in [plate]\n  did you mean \"material\"?  keys "
                  "here: model, size, elements, edges, opening, surround, surround_size, material",
                  "case.toml:8:19: error: size[1] = 406 has no unit; a length is needed (m, cm, mm, in, "
                  "ft)\n  the unit is part of the value: \"406 m\"",
                  "case.toml:10:13: error: stand_off = \"150 kg\" is a mass; a length is needed (m, cm, mm, in, ft)",
                  "case.toml:13:16: error: inner_radius 80 mm is not smaller than outer_radius 76.2 mm\n  the sand is "
                  "a shell between the two"));
  EXPECT_THAT(result.resolved, IsEmpty());
}

TEST(Diagnostics, MistakesInSeveralFilesAndOptions_AreReportedTogether) {
  CaseFolder folder;
  folder.write("sand.toml", "[soil]\nkind = \"drie\"\n").write("broken.toml", "[run]\nuntil = \n");
  folder.write("case.toml", "[case]\nuse = [\"sand.toml\", \"broken.toml\"]\n" +
                                sound_case("[efects]\n[levels.coarse]\nsand = 4\n"));
  folder.write("reference.toml", "[[references]]\nquantity = \"impulse\"\nsource = \"test\"\nvalue = \"1 N s\"\n");
  CaseOverrides overrides = with_set({{"run.untl", "2 ms"}, {"soil.friction", "rough"}, {"nonsense", ""}});
  overrides.level = "coarce";
  overrides.seed = "-1";
  const CaseRead result = folder.read("case.toml", overrides);
  const std::vector<std::string> expected{
      "sand.toml:2:8: error: kind = \"drie\" is not a choice here\n  did you mean \"dry\"?  choices: none, dry, wet",
      "broken.toml:2:9: error: not valid TOML: ",
      "case.toml:10:2: error: unknown section [efects]\n  did you mean \"effects\"?",
      "case.toml:12:1: error: unknown key \"sand\" in [levels.coarse]\n  keys here: charge, soil, air, elements",
      "reference.toml:2:12: error: unknown result \"impulse\"",
      "--set run.untl=2 ms: error: unknown key \"untl\" in [run]\n  did you mean \"until\"?",
      "--set soil.friction=rough: error: friction = \"rough\" is a text; a number is needed",
      "--set nonsense=: error: KEY=VALUE is needed",
      "--seed -1: error: seed = -1 is out of range",
      "--level coarce: error: unknown level \"coarce\"\n  did you mean \"coarse\"?  levels here: coarse"};
  ASSERT_EQ(result.errors.size(), expected.size()) << all_errors(result);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_THAT(result.errors[i], StartsWith(expected[i]));
}

TEST(Diagnostics, EveryKindOfValue_NamesItsMistake) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"[run]\nsettle = \"yes\"", "settle = \"yes\" is a text; true or false is needed"},
      {"[run]\nseed = 1.5", "seed = 1.5 is a number; a count (a whole number) is needed"},
      {"[case]\ntitle = 3", "title = 3 is a number; a text in quotes is needed"},
      {"[run]\nuntil = \"2 msec\"", "until = \"2 msec\": unknown unit \"msec\""},
      {"[run]\nuntil = \"soon\"", "until = \"soon\" does not begin with a number; a time is needed (s, ms, us)"},
      {"[run]\nuntil = 1979-05-27", "until = a date or time is a date or time; a time is needed"},
      {"[coupling]\nwindow = \"automatic\"", "window = \"automatic\" does not begin with a number; a time is needed"},
      {"[domain]\nsize = [\"1 m\", \"1 m\"]", "is a list of 2; three values are needed, each a length"},
      {"[plate]\nelements = [10, 10, 0]", "elements[2] = 0 is out of range; 1 <= elements <= 10000 is needed"},
      {"[contact]\nsurface_restitution = 1.5", "is out of range; 0 <= surface_restitution <= 1 is needed"},
      {"[soil]\nfriction = inf", "friction = inf is not a finite number"},
      {"[effects]\nheatng = \"on\"", "unknown effect \"heatng\"\n  did you mean \"heating\"?"},
      {"[effects]\nheating = true", "heating = true is not a choice here\n  choices: on, off"},
      {"[run.until]\nx = 1", "until = {...} is a table; a time is needed"},
      {"run = 3", "run = 3 is not a table; write [run]"},
      {"until = \"2 ms\"", "unknown key \"until\" outside of any section\n  \"until\" belongs in [run]"},
      {"[plate]\nuntil = \"2 ms\"", "unknown key \"until\" in [plate]\n  \"until\" belongs in [run]"},
      {"[charge]\nexplosive = \"c5\"", "explosive = \"c5\" is not a choice here\n  did you mean \"c4\"?"},
      {"[charge]\nexplosive = 4", "explosive = 4 is neither a name nor a table"}};
  for (const auto& [text, message] : mistakes) {
    CaseFolder folder;
    folder.write("more.toml", text);
    folder.write("case.toml", "[case]\nuse = [\"more.toml\"]\n" + sound_case());
    const CaseRead result = folder.read();
    ASSERT_EQ(result.errors.size(), 1u) << text << "\n" << all_errors(result);
    EXPECT_THAT(result.errors[0], HasSubstr(message)) << text;
  }
}

TEST(Diagnostics, NothingStated_NamesWhatIsMissing) {
  CaseFolder folder;
  folder.write("case.toml", "[charge]\nexplosive = { density = \"1 g/cm3\" }\n");
  const std::string text = all_errors(folder.read());
  for (const char* missing : {"mass is missing in [charge]", "energy is missing in [charge.explosive]",
                              "stand_off is missing", "size is missing in [plate]", "material is missing in [plate]"})
    EXPECT_THAT(text, HasSubstr(missing));
  EXPECT_THAT(all_errors(folder.read("nowhere")), HasSubstr("nowhere:1:1: error: cannot read this file"));
}

}  // namespace
}  // namespace standoff::test
