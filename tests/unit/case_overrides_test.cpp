// Law: what a case states of an effect wins over the criterion and reaches the physics: what is off leaves nothing
// behind in the specification, and takes along what needs it. What cannot reach the physics is an error with its
// reason. The reference cases have the effects of the paper [Borvik 2011, sec. 3]. Compared as values and words: no
// tolerance.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/case/effects/registry.hpp"
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

// What is off leaves nothing behind in the specification for a solver to compute.
TEST(EffectOverrides, LeftOut_ReachTheLawsOfTheSoil) {
  const auto wet = [](const char* effect) {
    return read_case(cases + "/borvik_2011/wet_150mm", with_set({{effect, "off"}})).spec.soil;
  };
  EXPECT_GT(wet("effects.friction").damping, 0.0);
  EXPECT_EQ(wet("effects.damping").damping, 0.0);
  EXPECT_GT(wet("effects.damping").radius_spread, 0.0);
  EXPECT_EQ(wet("effects.radius_spread").radius_spread, 0.0);
  const SoilSpec dry = read_case(cases + "/borvik_2011/dry_150mm", with_set({{"effects.friction", "off"}})).spec.soil;
  EXPECT_EQ(dry.friction, 0.0);
}

TEST(EffectOverrides, LeftOut_TakeAlongWhatNeedsThem) {
  const auto without = [](const char* effect) {
    return read_case(cases + "/borvik_2011/bare_150mm", with_set({{effect, "off"}})).spec;
  };
  EXPECT_FALSE(without("effects.air").air.on || without("effects.air").effect("ambient_pressure"));
  EXPECT_FALSE(without("effects.heating").effect("expansion"));
  EXPECT_TRUE(without("effects.expansion").effect("heating"));
}

// On with nothing to act on, or off where nothing could take its place: one error each, with the reason.
TEST(EffectOverrides, OverridesThatCannotReachThePhysics_AreErrors) {
  const auto error = [](std::vector<std::pair<std::string, std::string>> set) {
    const CaseRead read = read_case(cases + "/borvik_2011/dry_150mm", with_set(std::move(set)));
    return read.errors.size() == 1 ? read.errors[0] : "errors: " + std::to_string(read.errors.size());
  };
  EXPECT_THAT(error({{"soil.friction", "0"}, {"effects.friction", "on"}}), HasSubstr("mu = 0"));
  EXPECT_THAT(error({{"effects.damping", "on"}}), HasSubstr("damping = \"on\" cannot reach the physics: xi = 0"));
  EXPECT_THAT(error({{"effects.air", "on"}}), HasSubstr("air.mode = \"off\""));
  EXPECT_THAT(error({{"plate.material.C", "0"}}), HasSubstr("strain_rate = \"on\" cannot reach the physics: C = 0"));
  EXPECT_THAT(error({{"effects.co_volume", "off"}}), HasSubstr("co_volume = \"off\" cannot reach the physics"));
}

// The paper's model: air only round the bare charge, friction only in dry sand, dashpots and unlike grains only in wet.
TEST(EffectOverrides, OfTheNineReferenceCases_AreThoseOfThePaper) {
  for (const std::string kind : {"bare", "dry", "wet"})
    for (const std::string distance : {"150", "200", "250"}) {
      const CaseRead read = read_case(cases + "/borvik_2011/" + kind + "_" + distance + "mm");
      ASSERT_EQ(all_errors(read), "");
      for (const char* name : {"air", "ambient_pressure"}) EXPECT_EQ(read.spec.effect(name), kind == "bare") << name;
      EXPECT_EQ(read.spec.effect("friction"), kind == "dry");
      for (const char* name : {"damping", "radius_spread"}) EXPECT_EQ(read.spec.effect(name), kind == "wet") << name;
      for (const char* name : {"strain_rate", "heating", "expansion"})
        EXPECT_TRUE(decision(read, name).on && decision(read, name).overridden) << name;
    }
}

}  // namespace
}  // namespace standoff::test
