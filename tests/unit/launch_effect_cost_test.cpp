// What an effect costs is taken seed by seed: what the seeds have in common drops out. By hand; tolerances are
// rounding.
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "coupling/launcher/effect_study.hpp"

namespace standoff::launch {
namespace {

CostRun run(std::uint64_t seed, double processor_s, double peak, int exit_code = 0) {
  CostRun r;
  r.seed = seed, r.processor_s = processor_s, r.peak_m = peak, r.exit_code = exit_code;
  return r;
}

const std::vector<CostRun> plain{run(1, 40.0, 0.030), run(2, 50.0, 0.050)},
    turned{run(1, 30.0, 0.031), run(2, 38.0, 0.051)};

TEST(EffectCosts, SeedsThatDifferAlike_HaveADifferenceWithoutScatter) {
  const EffectDifference d = paired_difference(turned, plain);
  EXPECT_DOUBLE_EQ(d.processor_s.mean, -11.0);
  EXPECT_DOUBLE_EQ(d.processor_s.standard_error(), 1.0);
  EXPECT_NEAR(d.peak.mean, 1e-3, 1e-15);
  EXPECT_NEAR(d.peak.standard_error(), 0.0, 1e-15);
  EXPECT_EQ(d.permanent.count, 0) << "unknown in every run";
}

TEST(EffectCosts, SeedThatFailed_IsLeftOutOnBothSides) {
  const EffectDifference d = paired_difference({turned[0], run(2, 0.0, 0.0, 3)}, plain);
  EXPECT_EQ(d.processor_s.count, 1);
  EXPECT_DOUBLE_EQ(d.processor_s.mean, -10.0);
}

TEST(EffectCosts, Table_NamesWhatWasTurnedAndHow) {
  const std::string text = effect_table({{{}, plain}, {{"friction", false, {}}, turned}});
  EXPECT_NE(text.find("friction off"), std::string::npos) << text;
  EXPECT_NE(text.find("-11.00 ± 1.00 s"), std::string::npos) << text;
  EXPECT_NE(text.find("+1.00 ± 0.00 mm"), std::string::npos) << text;
}

/// What is off is priced by turning it on, the air by its own key.
TEST(EffectCosts, OfTheDryCase_TurnOnWhatIsOffAndOffWhatIsOn) {
  CostOptions options;
  options.case_path = std::string(STANDOFF_SOURCE_DIR) + "/cases/borvik_2011/dry_150mm";
  std::map<std::string, EffectVariant> found;
  for (const EffectVariant& variant : effect_variants(options, "coarse")) found[variant.effect] = variant;
  ASSERT_TRUE(found.contains("grain_rotation") && found.contains("air") && found.contains("friction"));
  EXPECT_TRUE(found["grain_rotation"].on && found["air"].on);
  EXPECT_FALSE(found["friction"].on);
  EXPECT_EQ(found["grain_rotation"].set.first, "effects.grain_rotation");
  EXPECT_EQ(found["air"].set.first, "air.mode");
}

}  // namespace
}  // namespace standoff::launch
