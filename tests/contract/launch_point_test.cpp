// A case whose model is a material point: the structure program alone draws flow curves, with the real programs.
// Static flow of copper: the original law has no rate effect at 1e-3 per second, so the isothermal curve is A + B p^n
// of its preset; ten digits are written.
#include <cmath>

#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class LauncherPoint : public LauncherStage {
 protected:
  LauncherPoint() { real_programs_ = true; }
};

TEST_F(LauncherPoint, RunOfCopper_WritesTheFlowCurvesOfItsLaw) {
  start({"run", STANDOFF_SOURCE_DIR "/cases/borvik_2011/material_al6xn", "--set", "plate.material=ofhc_copper", "--set",
         "effects.expansion=off", "--out", "run", "--quiet"});  // the preset has no expansion
  ASSERT_EQ(finish(60.0), 0) << errors();
  EXPECT_EQ(record()["status"], "done");
  EXPECT_EQ(record()["structure_model"], "material_point");
  std::istringstream rows(read_file(root_ / "run" / "flow_curves.csv"));
  std::string line;
  std::getline(rows, line);
  EXPECT_EQ(line, "plastic_strain,rate_per_s,start_temperature_K,heated,stress_Pa,temperature_K");
  int compared = 0;
  while (std::getline(rows, line)) {
    double p = 0.0, rate = 0.0, start = 0.0, heated = 0.0, stress = 0.0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &p, &rate, &start, &heated, &stress), 5) << line;
    if (rate != 1e-3 || heated != 0.0 || start != 293.0) continue;
    const double flow = 90e6 + 292e6 * std::pow(p, 0.31);
    EXPECT_NEAR(stress, flow, 1e-8 * flow) << "Pa at p = " << p;
    ++compared;
  }
  EXPECT_EQ(compared, 100);
}

TEST_F(LauncherPoint, ElasticMaterial_HasNoFlowCurveAndSaysSo) {
  start({"run", STANDOFF_SOURCE_DIR "/cases/borvik_2011/material_al6xn", "--set", "plate.material.law=elastic", "--out",
         "run", "--quiet"});
  EXPECT_EQ(finish(60.0), 2);
  EXPECT_NE(errors().find("does not yield"), std::string::npos) << errors();
}

// No plate is priced: no elements, no windows, no memory, and nothing whose cost could be studied.
TEST_F(LauncherPoint, PlanAndCost_PriceNoPlate) {
  const std::string point = STANDOFF_SOURCE_DIR "/cases/borvik_2011/material_al6xn";
  ASSERT_EQ(run({"plan", point, "--json"}), 0) << errors();
  const auto j = nlohmann::json::parse(output(), nullptr, false);
  EXPECT_EQ(j["counts"]["elements"], 0) << j;
  EXPECT_EQ(j["counts"]["windows"], 0) << j;
  EXPECT_EQ(j["memory"]["structure_bytes"], 0.0) << j;
  for (const auto& [what, seconds] : j["core_seconds"].items()) EXPECT_EQ(seconds, 0.0) << what;
  EXPECT_EQ(run({"cost", point, "--out", "study"}), 2);
  EXPECT_NE(errors().find("no mesh and no particles"), std::string::npos) << errors();
  EXPECT_FALSE(files::exists(root_ / "study/cost.csv"));
}

}  // namespace
}  // namespace standoff::launch
