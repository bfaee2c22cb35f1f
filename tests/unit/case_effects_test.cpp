// Law: an effect is on when its physical criterion calls for it, or when the case says so and there is something to act
// on; its reason carries the figures. The fingerprint follows every value a result depends on, and no title. Figures in
// reasons are printed with two or three digits, so they are compared as text.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/case/effects/registry.hpp"
#include "coupling/case/presets.hpp"
#include "coupling/case/schema.hpp"
#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::HasSubstr;

const std::string cases = std::string(STANDOFF_SOURCE_DIR) + "/cases";

EffectDecision decision(const CaseRead& result, const std::string& name) {
  EXPECT_EQ(all_errors(result), "");
  for (const EffectDecision& effect : result.spec.effects)
    if (effect.name == name) return effect;
  ADD_FAILURE() << "no effect " << name;
  return {};
}
EffectDecision bare(std::vector<std::pair<std::string, std::string>> set, const std::string& name) {
  CaseFolder folder;
  return decision(folder.write("case.toml", sound_case()).read("case.toml", with_set(std::move(set))), name);
}
EffectDecision dry(std::vector<std::pair<std::string, std::string>> set, const std::string& name) {
  return decision(read_case(cases + "/borvik_2011/dry_150mm", with_set(std::move(set))), name);
}

TEST(Effects, FrictionAndDamping_FollowTheSoil) {
  EXPECT_EQ(dry({}, "friction").reason, "mu = 0.3 > 0: tangential history is stored");
  EXPECT_TRUE(dry({}, "friction").on);
  EXPECT_FALSE(dry({{"soil.friction", "0"}}, "friction").on);
  EXPECT_FALSE(dry({}, "damping").on);
  EXPECT_TRUE(dry({{"soil.kind", "wet"}}, "damping").on);
  EXPECT_TRUE(dry({{"soil.kind", "wet"}}, "radius_spread").on);
  EXPECT_FALSE(bare({}, "friction").on);
  EXPECT_EQ(bare({}, "friction").reason, "there is no sand");
}

TEST(Effects, HardCore_FollowsTheSpeedOfThrownGrains) {
  // 15 mg of products at 2 sqrt(3.5 * 5.434 MJ/kg) = 8.72 km/s against 56.4 mg: 2 * 15/71.4 * 8.72 = 3.67 km/s; a pair
  // at rest in its way is pressed by 8.60e-4 s/m * 3.67 km/s = 3.15 radii, see hard_core.
  EXPECT_TRUE(dry({}, "hard_core").on);
  EXPECT_THAT(dry({}, "hard_core").reason, HasSubstr("throw grains at 3.7 km/s: v (m/2k)^(1/2) is 3.2 radii"));
  EXPECT_FALSE(dry({{"soil.stiffness", "40 GN/m"}}, "hard_core").on);
  EXPECT_FALSE(dry({{"charge.particles", "1000000"}}, "hard_core").on) << "light products throw nothing";
  EXPECT_FALSE(bare({}, "hard_core").on);
}

TEST(Effects, GasRules_FollowTheExplosive) {
  EXPECT_TRUE(bare({}, "internal_energy").on);
  EXPECT_THAT(bare({}, "internal_energy").reason, HasSubstr("60 % of the energy is motion"));  // 3 (1.4 - 1) / 2
  EXPECT_FALSE(bare({{"charge.explosive.gamma", "1.6666666666666667"}}, "internal_energy").on);
  EXPECT_THAT(bare({}, "co_volume").reason, HasSubstr("2.4-fold"));  // Z(0.2) = 1.232 / 0.512 = 2.41
  EXPECT_FALSE(bare({{"charge.explosive.fill", "0"}}, "co_volume").on);
  EXPECT_THAT(bare({}, "detonation_timing").reason, HasSubstr("needs 6.9 us"));  // 2 * 28.18 mm / 8190 m/s = 6.88 us
  EXPECT_FALSE(bare({{"charge.explosive.detonation_speed", "10000 km/s"}}, "detonation_timing").on);
}

TEST(Effects, PlateRules_FollowConstantsAndLoad) {
  for (const char* name : {"strain_rate", "heating", "hardening", "surface_recession", "relaxation"})
    EXPECT_TRUE(bare({}, name).on) << name << ": " << bare({}, name).reason;
  EXPECT_FALSE(bare({{"plate.material.C", "0"}}, "strain_rate").on);
  EXPECT_FALSE(bare({{"plate.material.taylor_quinney", "0"}}, "heating").on);
  EXPECT_FALSE(bare({{"plate.material.thermal_expansion", "0 1/K"}}, "expansion").on);
  EXPECT_FALSE(bare({{"plate.material.B", "0 Pa"}}, "hardening").on);
  EXPECT_FALSE(bare({{"charge.mass", "0.01 g"}}, "heating").on);            // a firecracker does not heat the plate
  EXPECT_FALSE(bare({{"charge.mass", "0.01 g"}}, "surface_recession").on);  // nor push it away
}

TEST(Effects, StatedByTheCase_OverridesTheRule) {
  EXPECT_TRUE(dry({}, "expansion").overridden);
  EXPECT_THAT(dry({}, "heating").reason, HasSubstr("stated by the case"));
  EXPECT_FALSE(dry({{"effects.friction", "off"}}, "friction").on);
  CaseSpec spec = read_case(cases + "/borvik_2011/dry_150mm", with_set({{"effects.symmetry", "off"}})).spec;
  EXPECT_FALSE(spec.run.quarter_symmetry);
  EXPECT_THROW(spec.effect("gravity"), std::out_of_range);
}

TEST(Fingerprint, ChangesWithWhatAResultDependsOn_AndOnlyWithThat) {
  const auto hash = [](const char* key, const char* value) {
    return read_case(cases + "/borvik_2011/dry_150mm", with_set({{key, value}})).hash;
  };
  const std::string plain = read_case(cases + "/borvik_2011/dry_150mm").hash;
  std::set<std::string> seen{plain};
  for (const auto& [key, value] : {std::pair{"run.seed", "2"},
                                   {"soil.friction", "0.1"},
                                   {"effects.heating", "off"},
                                   {"run.stand_off", "150.0000000000001 mm"},
                                   {"charge.explosive", "c4_paper"}})
    EXPECT_TRUE(seen.insert(hash(key, value)).second) << key;
  EXPECT_EQ(hash("case.title", "another"), plain);
  EXPECT_EQ(hash("run.stand_off", "15 cm"), plain);
  EXPECT_EQ(hash("levels.paper.soil", "5"), plain);
}

TEST(Schema, EveryKeyAndPreset_IsValidAndDocumented) {
  for (const KeyEntry& entry : schema()) {
    EXPECT_FALSE(entry.doc.empty()) << entry.path;
    EXPECT_THAT(describe_key(entry.path), HasSubstr(std::string(entry.doc))) << entry.path;
    EXPECT_EQ(&entry, find_key(entry.path)) << entry.path << " is there twice";
  }
  for (const Preset& preset : presets())
    for (const PresetValue& value : preset.values) EXPECT_NE(find_key(value.path), nullptr) << value.path;
}

}  // namespace
}  // namespace standoff::test
