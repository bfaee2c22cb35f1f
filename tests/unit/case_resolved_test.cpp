// Law: a resolved case is a case. Reading it gives the same specification bit for bit and the same fingerprint, and
// resolving it again changes nothing but the origins. The fingerprint follows every value a result depends on, and no
// title.
#include <fstream>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string cases = std::string(STANDOFF_SOURCE_DIR) + "/cases";

/// Every folder below cases/ that holds a case.
std::vector<std::string> all_cases() {
  std::vector<std::string> list;
  for (const auto& entry : fs::recursive_directory_iterator(cases))
    if (entry.path().filename() == "case.toml") list.push_back(entry.path().parent_path().string());
  return list;
}

std::string without_origins(const std::string& text) {
  return std::regex_replace(text, std::regex(" *# [^\n]*"), "");
}

/// A unit cell is read as one, every other case as a scene, as `standoff check` does.
void expect_round_trip(const std::string& path, CaseOverrides overrides) {
  CaseOverrides again;
  again.purpose = overrides.purpose = CasePurpose::either;
  const CaseRead first = read_case(path, overrides);
  ASSERT_EQ(all_errors(first), "") << path;
  CaseFolder folder;
  CaseRead second = folder.write("case.resolved.toml", first.resolved).read("case.resolved.toml", again);
  ASSERT_EQ(all_errors(second), "") << first.resolved;
  EXPECT_EQ(second.hash, first.hash);
  EXPECT_EQ(without_origins(second.resolved), without_origins(first.resolved));
  const CaseRead third = folder.write("case.resolved.toml", second.resolved).read("case.resolved.toml", again);
  EXPECT_EQ(without_origins(third.resolved), without_origins(second.resolved));
  second.spec.folder = first.spec.folder;  // the only thing that moved
  EXPECT_TRUE(second.spec == first.spec) << first.resolved << "\n---- read back ----\n" << second.resolved;
}

TEST(AllCases, EveryLevel_ReadsWithoutErrorsAndRepeatsItself) {
  const std::vector<std::string> found = all_cases();
  ASSERT_GE(found.size(), 3u);
  for (const std::string& path : found) {
    std::vector<std::string> levels = read_case(path).spec.levels;
    levels.emplace_back("");
    for (const std::string& level : levels) {
      SCOPED_TRACE(path + " " + level);
      CaseOverrides overrides;
      overrides.level = level;
      expect_round_trip(path, overrides);
    }
  }
}

TEST(AllCases, BorvikLevels_HaveTheCountsOfThePaper) {
  using Counts = std::vector<std::array<long, 2>>;
  const auto counts = [](const std::string& name, bool sand) {
    Counts list;
    for (const char* level : {"coarse", "medium", "fine", "paper"}) {
      CaseOverrides overrides;
      overrides.level = level;
      const CaseSpec spec = read_case(cases + "/borvik_2011/" + name, overrides).spec;
      list.push_back({spec.charge.particles, sand ? spec.soil.particles : spec.air.particles});
    }
    return list;
  };
  EXPECT_EQ(counts("bare_150mm", false),
            (Counts{{10000, 500000}, {20000, 1000000}, {40000, 2000000}, {40000, 2000000}}));
  EXPECT_EQ(counts("dry_150mm", true), (Counts{{10000, 50000}, {40000, 200000}, {80000, 400000}, {160000, 800000}}));
}

TEST(AllCases, DryAt150mm_HoldsTheFiguresOfThePaper) {
  const CaseSpec spec = read_case(cases + "/borvik_2011/dry_150mm").spec;
  EXPECT_NEAR(spec.charge.radius, 28.2e-3, 0.05e-3);  // a third of a unit of the last digit given
  EXPECT_EQ(spec.charge.detonator.z, spec.run.stand_off + spec.charge.radius);
  EXPECT_EQ(spec.soil.bulk_density, 1620.0);
  EXPECT_EQ(spec.plate.material.B, 1902e6);
  EXPECT_EQ(spec.run.until, 2e-3);
  EXPECT_TRUE(spec.effect("friction") && spec.effect("heating") && spec.effect("expansion") &&
              spec.effect("strain_rate"));
  EXPECT_FALSE(spec.effect("damping") || spec.effect("air") || spec.effect("radius_spread"));
  ASSERT_EQ(spec.references.size(), 6u);
  EXPECT_EQ(spec.references[0], (ReferenceValue{"permanent_centre_deflection_m", "paper, 10k/50k", 0.0317}));
  EXPECT_EQ(spec.references[5].value, 250.0);
  for (const std::string& path : all_cases()) {
    std::ifstream file(path + "/case.toml");
    EXPECT_LE(std::count(std::istreambuf_iterator<char>(file), {}, '\n'), 60) << path;
  }
}

TEST(Resolved, OverridesWordsAndOddValues_SurviveTheRoundTrip) {
  CaseOverrides overrides = with_set({{"run.until", "0.1 ms"},
                                      {"plate.size", "[16 in, 1.3 ft, 0.13385826771653542 in]"},
                                      {"coupling.window", "step"},
                                      {"contact.surface_restitution", "soil"},
                                      {"contact.surface_friction", "soil"},
                                      {"soil.damping", "0.02"},
                                      {"effects.damping", "off"},
                                      {"effects.relaxation", "off"},
                                      {"run.symmetry", "none"},
                                      {"soil.particles", "1234"},
                                      {"soil.packing", "0.61"},
                                      {"charge.detonator", "[1 mm, 2 mm, 0.151 m]"},
                                      {"domain.size", "[1.1 m, 1.2 m, 1.3 m]"},
                                      {"case.title", "a \"quoted\" \\ title # no comment"}});
  overrides.seed = "9007199254740993";  // 2^53 + 1: not a double
  overrides.level = "fine";
  expect_round_trip(cases + "/borvik_2011/dry_150mm", overrides);
  const CaseRead result = read_case(cases + "/borvik_2011/dry_150mm", overrides);
  EXPECT_EQ(result.spec.run.seed, 9007199254740993u);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(result.spec.soil.damping, 0.0) << "left out of the specification, kept in the text";
}

}  // namespace
}  // namespace standoff::test
