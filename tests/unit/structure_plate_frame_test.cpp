// What a frame shows, against closed forms: a plate bent into a state of uniform stretch, u = H X with uniform H and
// velocity H X / T, has in every cell the stress of Hooke's law (logarithmic strain ln(1 + a) on the axes), the rate
// a / (T (1 + a)) and the thickness h (1 + c). Linear fields are exact in cubic elements: rounding of positions of 0.2
// m over node distances of 1e-3 m, 1e-13 of strain; 1e-9 of stress asked. Bricks of 8 nodes have no field of their own
// for bending: rolled into a cylinder, w = kappa x^2 / 2, they strain by d = kappa z along x, nothing across the plate
// by shear, and -nu / (1 - nu) d through it, because no stress acts there. All Gauss points lie at |z| = h / (2
// sqrt(3)). The frame's differences and the alpha of the element leave 1e-4: its tolerance, 1e-11 of strain, over
// strains of 1e-6 in a step.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "tests/unit/structure_plate_case.hpp"

namespace standoff::structure {
namespace {

std::map<std::string, double> first_cell(const StructureFrame& frame) {
  std::map<std::string, double> values;
  for (const auto& [name, data] : frame.cell_data) values[name] = data.front();
  return values;
}

TEST(PlateFrame_UniformStretch, FreePlate_ShowsHookesStressRateAndThickness) {
  CaseSpec spec = testing::plate_case(2, false);
  spec.plate.edges = "free";
  PlateHex64 model(spec, 1);
  const double a = 4e-4, b = -2e-4, c = 3e-4, time = 1e-3;
  std::vector<double> u, v;
  for (const Vec3& x : model.plate().mesh().position)
    for (const double move : {a * x.x, b * x.y, c * x.z}) u.push_back(move), v.push_back(move / time);
  model.relaxation()->set_state(u, v);
  const auto shown = first_cell(model.frame());
  const double e[3] = {std::log1p(a), std::log1p(b), std::log1p(c)}, sum = e[0] + e[1] + e[2];
  const double shear = 195e9 / 2.6, bulk = 195e9 / 1.2, j = (1.0 + a) * (1.0 + b) * (1.0 + c);
  const char* const normal[3] = {"stress_xx_Pa", "stress_yy_Pa", "stress_zz_Pa"};
  double square = 0.0, rate = 0.0;
  const double d[3] = {a / (time * (1.0 + a)), b / (time * (1.0 + b)), c / (time * (1.0 + c))};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(shown.at(normal[i]), (2.0 * shear * (e[i] - sum / 3.0) + bulk * sum) / j, 1e-9 * 195e9 * a) << "Pa";
    square += std::pow(2.0 * shear * (e[i] - sum / 3.0) / j, 2);
    rate += std::pow(d[i] - (d[0] + d[1] + d[2]) / 3.0, 2);
  }
  EXPECT_NEAR(shown.at("von_mises_Pa"), std::sqrt(1.5 * square), 1e-9 * 195e9 * a) << "Pa";
  EXPECT_NEAR(shown.at("strain_rate_per_s"), std::sqrt(2.0 / 3.0 * rate), 1e-9 * a / time) << "1/s";
  EXPECT_NEAR(shown.at("thickness_m"), 0.0034 * (1.0 + c), 1e-12) << "m";
  for (const char* name : {"stress_xy_Pa", "stress_yz_Pa", "stress_zx_Pa"})
    EXPECT_NEAR(shown.at(name), 0.0, 1e-9 * 195e9 * a) << name;
  EXPECT_EQ(shown.at("plastic_strain"), 0.0) << "the state was meant to stay elastic";
}

TEST(PlateFrame_Bending, BricksRolledIntoACylinder_ShowTheRateOfTheirOwnStrains) {
  CaseSpec spec = testing::plate_case(2, false);
  spec.plate.model = "plate_hex8", spec.plate.edges = "free";
  const auto model = make_structural_model(spec, 1);
  auto& plate = dynamic_cast<PlateHex64&>(*model);
  const double rate = 1e4, middle = -0.5 * spec.plate.size.z;  // 1/(m s), curvature gained
  std::vector<double> u(static_cast<std::size_t>(plate.relaxation()->dofs()), 0.0), v;
  for (const Vec3& x : plate.plate().mesh().position)
    for (const double move : {-rate * x.x * (x.z - middle), 0.0, 0.5 * rate * x.x * x.x}) v.push_back(move);
  plate.relaxation()->set_state(u, v);
  const double nu = spec.plate.material.poissons_ratio, through = -nu / (1.0 - nu), mean = (1.0 + through) / 3.0;
  const double d = rate * spec.plate.size.z / (2.0 * std::sqrt(3.0));
  const double square = std::pow(1.0 - mean, 2) + mean * mean + std::pow(through - mean, 2);
  const StructureFrame frame = plate.frame();
  const auto column =
      std::ranges::find(frame.cell_data, "strain_rate_per_s", [](const auto& data) { return data.first; });
  ASSERT_EQ(column->second.size(), 36u);
  for (const double shown : column->second) EXPECT_NEAR(shown / (d * std::sqrt(2.0 / 3.0 * square)), 1.0, 1e-4);
}

TEST(PlateFrame_Effects, WhatIsOff_HasNoColumn) {
  CaseSpec spec = testing::plate_case(2, true);
  const auto all = first_cell(PlateHex64(spec, 1).frame());
  EXPECT_TRUE(all.contains("plastic_strain") && all.contains("temperature_K"));
  for (EffectDecision& e : spec.effects) e.on = e.name != "heating" && e.name != "expansion";
  const auto cold = first_cell(PlateHex64(spec, 1).frame());
  EXPECT_TRUE(cold.contains("plastic_strain") && !cold.contains("temperature_K"));
  for (EffectDecision& e : spec.effects) e.on = false;
  const auto elastic = first_cell(PlateHex64(spec, 1).frame());
  EXPECT_TRUE(!elastic.contains("plastic_strain") && elastic.contains("von_mises_Pa"));
}

}  // namespace
}  // namespace standoff::structure
