// Comparison of two runs: difference = b - a, relative = (b - a) / |a|. The numbers are chosen so that both are exact
// in binary (quarters and halves), hence equality.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "coupling/launcher/run_comparison.hpp"

namespace standoff::launch {
namespace {

using ::testing::HasSubstr;

ComparedRun run_with(double impulse, const char* elements, const char* hash) {
  ComparedRun run;
  run.folder = "runs/x";
  run.record = {{"status", "done"},
                {"case", "x"},
                {"level", "coarse"},
                {"results", {{"impulse_Ns", impulse}, {"peak_centre_deflection_m", 0.0}}},
                {"effects", {{{"name", "heating"}, {"on", true}}}},
                {"counts", {{"windows", 100}}},
                {"timing", {{"wall_s", 2.0}, {"particle", {{"compute_s", 1.0}}}}},
                {"provenance", {{"state_hash", hash}, {"version", "1"}}}};
  run.inputs = {{"plate.elements", elements}, {"run.seed", "1"}};
  return run;
}

OrderedJson row_of(const OrderedJson& list, const std::string& key) {
  for (const OrderedJson& row : list)
    if (row["key"] == key) return row;
  return nullptr;
}

TEST(RunComparison_Results, DifferenceAndRelative_AreOfBAgainstA) {
  const auto j = comparison_json(run_with(128.0, "[2, 2, 1]", "aa"), run_with(160.0, "[2, 2, 1]", "bb"));
  const auto row = row_of(j["results"], "impulse_Ns");
  EXPECT_EQ(row["difference"], 32.0);
  EXPECT_EQ(row["relative"], 0.25);
  EXPECT_EQ(j["same_bits"], false);
}

TEST(RunComparison_Results, DifferenceFromZeroOrNothing_HasNoRelative) {
  ComparedRun a = run_with(1.0, "[2, 2, 1]", "aa"), b = run_with(1.0, "[2, 2, 1]", "aa");
  b.record["results"]["peak_centre_deflection_m"] = 0.5;
  b.record["results"]["impulse_sand_Ns"] = 3.0;
  const auto j = comparison_json(a, b);
  EXPECT_EQ(row_of(j["results"], "peak_centre_deflection_m")["difference"], 0.5);
  EXPECT_TRUE(row_of(j["results"], "peak_centre_deflection_m")["relative"].is_null());
  EXPECT_TRUE(row_of(j["results"], "impulse_sand_Ns")["a"].is_null());
  EXPECT_TRUE(row_of(j["results"], "impulse_sand_Ns")["difference"].is_null());
}

TEST(RunComparison_Inputs, OnlyDifferentOnes_AreListed) {
  ComparedRun a = run_with(1.0, "[2, 2, 1]", "aa"), b = run_with(1.0, "[4, 4, 1]", "aa");
  b.record["effects"][0]["on"] = false;
  const auto j = comparison_json(a, b);
  ASSERT_EQ(j["inputs"].size(), 2u) << j["inputs"].dump();
  EXPECT_EQ(row_of(j["inputs"], "plate.elements")["b"], "[4, 4, 1]");
  EXPECT_EQ(row_of(j["inputs"], "effects.heating")["b"], "off");
}

TEST(RunComparison_Text, SameRun_SaysSo) {
  const ComparedRun a = run_with(1.0, "[2, 2, 1]", "aa");
  const std::string text = comparison_text(comparison_json(a, a));
  EXPECT_THAT(text, HasSubstr("inputs that differ: no difference"));
  EXPECT_THAT(text, HasSubstr("provenance that differs: no difference"));
  EXPECT_THAT(text, HasSubstr("same state, bit for bit"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("counts, where different")));
}

TEST(RunComparison_Inputs, ResolvedCase_IsFlattenedWithoutLevelsAndReferences) {
  const auto path = std::filesystem::temp_directory_path() / ("launch_flat_" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << "[plate]\nsize = [\"1 m\", \"1 m\", \"2 mm\"]\n[plate.material]\nn = 0.5\n"
                         "[levels.coarse]\ncharge = 10\n[[references]]\nquantity = \"impulse_Ns\"\n";
  Diagnostics diagnostics;
  const auto document = read_document(path.string(), path.string(), diagnostics);
  std::filesystem::remove(path);
  ASSERT_TRUE(document.has_value());
  const std::map<std::string, std::string> expected{{"plate.size", "[\"1 m\", \"1 m\", \"2 mm\"]"},
                                                    {"plate.material.n", "0.5"}};
  EXPECT_EQ(flat_inputs(*document), expected);
}

}  // namespace
}  // namespace standoff::launch
