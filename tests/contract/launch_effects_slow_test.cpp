// Law: an effect that is off takes nothing: no stage of its own, no column of histories.csv (so no field of a message,
// which is where columns come from), no key of the results, no bytes, no seconds. What is its own stands in the table
// of effects (coupling/case/effects). A small run of every effect, on and off, with the real programs; nothing is
// measured, so there is no tolerance. 30 us: too short for the load to reach the plate, long enough for every row.
#include <sstream>

#include "coupling/case/case_reader.hpp"
#include "coupling/case/effects/registry.hpp"
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class LauncherEffects : public LauncherStage {
 protected:
  LauncherEffects() { real_programs_ = true; }

  using Set = std::vector<std::pair<std::string, std::string>>;
  /// Friction, damping, unequal grains and air in one scene.
  Set scene() const {
    return {{"soil.friction", "0.3"},     {"soil.particles", "2000"},    {"charge.particles", "400"},
            {"air.mode", "on"},           {"air.particles", "2000"},     {"run.until", "30 us"},
            {"observe.interval", "5 us"}, {"plate.elements", "[4,4,1]"}, {"effects.relaxation", "off"}};
  }
  void run_scene(const Set& set) {
    files::remove_all(root_ / "run");
    std::vector<std::string> arguments{"run", wet, "--level", "coarse", "--out", "run", "--quiet"};
    for (const auto& [key, value] : set) arguments.push_back("--set"), arguments.push_back(key + "=" + value);
    start(arguments);
    ASSERT_EQ(finish(120.0), 0) << errors();
  }
  bool has_column(const std::string& name) const {
    std::istringstream header(read_file(root_ / "run/histories.csv"));
    std::string line, column;
    std::getline(header, line);
    std::istringstream columns(line);
    while (std::getline(columns, column, ','))
      if (column == name) return true;
    return false;
  }
  bool has_stage(const nlohmann::json& record, const std::string& name) const {
    return record["timing"]["particle"]["stages"].contains(name) ||
           record["timing"]["structure"]["stages"].contains(name);
  }
  void expect_present(const Effect& effect, bool on) const {
    const nlohmann::json record = this->record();
    for (const std::string& stage : effect.stages) EXPECT_EQ(has_stage(record, stage), on) << stage;
    for (const std::string& column : effect.columns) EXPECT_EQ(has_column(column), on) << column;
    for (const std::string& key : effect.results) EXPECT_EQ(record["results"].contains(key), on) << key;
    for (const auto& row : record["effects"]) {
      if (row["name"] != effect.name) continue;
      EXPECT_EQ(row["on"], on);
      EXPECT_TRUE(on || (row["bytes"] == 0.0 && row["seconds"] == 0.0)) << row.dump();
    }
  }

  const std::string wet = STANDOFF_SOURCE_DIR "/cases/borvik_2011/wet_150mm";
};

TEST_F(LauncherEffects, EachInTurnOff_LeavesNothingOfItself) {
  run_scene(scene());
  CaseOverrides overrides;
  overrides.level = "coarse", overrides.set = scene();
  const CaseSpec spec = read_case(wet, overrides).spec;
  for (const Effect& effect : effect_rules()) expect_present(effect, spec.effect(effect.name));
  for (const Effect& effect : effect_rules()) {
    if (effect.inherent) continue;
    SCOPED_TRACE(effect.name);
    const bool on = !spec.effect(effect.name);
    Set turned = scene();
    std::erase_if(turned, [&](const auto& one) { return one.first == std::string("effects.") + effect.name; });
    turned.emplace_back(std::string("effects.") + effect.name, on ? "on" : "off");
    CaseOverrides all = overrides;
    all.set = turned;
    if (!read_case(wet, all).errors.empty()) continue;  // cannot act in this scene
    run_scene(turned);
    expect_present(effect, on);
  }
}

}  // namespace
}  // namespace standoff::launch
