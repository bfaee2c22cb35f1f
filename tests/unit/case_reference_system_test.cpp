// Law: the nine cases of the reference system are the experiments of [Borvik 2011, sec. 2 to 4]: stand-off, time, sand
// and counts are its figures. Values are compared exactly: reading rounds once, as the literal does. Derived ones to
// 1e-12: one multiplication.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

const std::string folder = std::string(STANDOFF_SOURCE_DIR) + "/cases/borvik_2011/";
constexpr std::array<const char*, 3> kinds{"bare", "dry", "wet"};
constexpr std::array<int, 3> stand_offs{150, 200, 250};

CaseSpec read(const std::string& name, const std::string& level = "") {
  CaseOverrides overrides;
  overrides.level = level;
  const CaseRead result = read_case(folder + name, overrides);
  EXPECT_EQ(all_errors(result), "") << name;
  return result.spec;
}

std::string case_name(const std::string& kind, int stand_off) {
  return kind + "_" + std::to_string(stand_off) + "mm";
}

TEST(ReferenceSystem, NineCases_DifferInStandOffAndSandOnly) {
  for (const std::string kind : kinds)
    for (const int stand_off : stand_offs) {
      SCOPED_TRACE(case_name(kind, stand_off));
      CaseSpec spec = read(case_name(kind, stand_off));
      EXPECT_EQ(spec.run.stand_off, stand_off / 1000.0);
      EXPECT_EQ(spec.run.until, kind == "bare" ? 1e-3 : 2e-3);
      EXPECT_EQ(spec.charge.mass, 0.15);
      EXPECT_EQ(spec.soil.kind != SoilKind::none, kind != "bare");
      EXPECT_TRUE(spec.run.settle && spec.run.quarter_symmetry);
      EXPECT_TRUE(spec.effect("strain_rate") && spec.effect("heating") && spec.effect("expansion"));
      const CaseSpec nearest = read(case_name(kind, 150));
      EXPECT_TRUE(spec.plate == nearest.plate && spec.soil == nearest.soil && spec.contact == nearest.contact);
    }
}

TEST(ReferenceSystem, EveryLevel_HasCountsAndMeshOfThePaper) {
  struct Level {
    const char* name;
    long charge, other;
    int elements;
  };
  const std::array<Level, 4> bare{{{"coarse", 10000, 500000, 10},
                                   {"medium", 20000, 1000000, 20},
                                   {"fine", 40000, 2000000, 40},
                                   {"paper", 40000, 2000000, 40}}};
  const std::array<Level, 4> sand{{{"coarse", 10000, 50000, 10},
                                   {"medium", 40000, 200000, 20},
                                   {"fine", 80000, 400000, 20},
                                   {"paper", 160000, 800000, 40}}};
  for (const std::string kind : kinds)
    for (const int stand_off : stand_offs)
      for (const Level& level : kind == "bare" ? bare : sand) {
        SCOPED_TRACE(case_name(kind, stand_off) + " " + level.name);
        const CaseSpec spec = read(case_name(kind, stand_off), level.name);
        EXPECT_EQ(spec.charge.particles, level.charge);
        EXPECT_EQ(kind == "bare" ? spec.air.particles : spec.soil.particles, level.other);
        EXPECT_EQ(spec.plate.elements, (std::array<int, 3>{level.elements, level.elements, 1}));
      }
}

TEST(ReferenceSystem, WetSand_IsSaturatedAndWithoutFriction) {
  const CaseSpec spec = read("wet_150mm");
  EXPECT_EQ(spec.soil.packing, 0.64);
  EXPECT_EQ(spec.soil.radius_spread, 0.025);
  EXPECT_EQ(spec.soil.bulk_density, 2020.0);
  EXPECT_NEAR(spec.soil.grain_density * 0.64 / 2020.0, 1.0, 1e-12);  // the water's mass is in the grains
  EXPECT_EQ(spec.soil.stiffness, 4e9);
  EXPECT_EQ(spec.soil.friction, 0.0);
  EXPECT_EQ(spec.soil.damping, 0.01);
  EXPECT_TRUE(spec.effect("damping") && spec.effect("radius_spread"));
  EXPECT_FALSE(spec.effect("friction"));  // no tangential history is stored
}

TEST(ReferenceSystem, References_AreThePublishedOnesAndNoneAt200mm) {
  const auto deflections = [](const std::string& name) {
    std::vector<double> values;  // mm; the last is the test
    for (const ReferenceValue& one : read(name).references)
      if (one.quantity == "permanent_centre_deflection_m") values.push_back(std::round(1e4 * one.value) / 10.0);
    return values;
  };
  using Values = std::vector<double>;
  EXPECT_EQ(deflections("bare_150mm"), (Values{19.7, 19.2, 19.4, 19.8, 17.0}));
  EXPECT_EQ(deflections("bare_250mm"), (Values{12.1, 12.3, 12.3, 11.3}));
  EXPECT_EQ(deflections("dry_150mm"), (Values{31.7, 31.6, 30.6, 30.6, 38.5}));
  EXPECT_EQ(deflections("dry_250mm"), (Values{18.1, 18.2, 18.5, 17.7, 18.5}));
  EXPECT_EQ(deflections("wet_150mm"), (Values{50.9, 51.2, 49.1, 48.0, 56.4}));
  EXPECT_EQ(deflections("wet_250mm"), (Values{31.4, 32.5, 33.3, 31.3, 34.5}));
  for (const std::string kind : kinds) EXPECT_TRUE(read(kind + "_200mm").references.empty()) << kind;
}

}  // namespace
}  // namespace standoff::test
