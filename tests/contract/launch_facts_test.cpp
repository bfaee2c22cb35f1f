// The verbs that tell what exists, as a user types them (contract sec. 2): exit codes, --json that parses, `new` that
// never overwrites and whose case `check` accepts. Exact.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

using LauncherFacts = LauncherStage;

TEST_F(LauncherFacts, EveryFactVerb_HasHelpAndJson) {
  for (const char* verb : {"doc", "effects", "presets", "models"}) {
    files::remove(root_ / "out.txt");
    EXPECT_EQ(run({verb, "--json"}), 0) << verb << errors();
    EXPECT_FALSE(nlohmann::json::parse(output(), nullptr, false).is_discarded()) << verb << output();
    EXPECT_EQ(run({verb, "--help"}), 0) << verb;
    EXPECT_EQ(run({verb}), 0) << verb;
  }
}

TEST_F(LauncherFacts, DocOfAKey_TellsItsRange) {
  EXPECT_EQ(run({"doc", "soil.packing"}), 0) << errors();
  EXPECT_NE(output().find("0 < packing <= 0.74"), std::string::npos) << output();
}

TEST_F(LauncherFacts, DocOfAnUnknownKey_IsExitTwoWithASuggestion) {
  EXPECT_EQ(run({"doc", "plate.materal"}), 2);
  EXPECT_NE(errors().find("did you mean \"material\"?"), std::string::npos) << errors();
}

TEST_F(LauncherFacts, NewCase_IsAcceptedAndNeverOverwritten) {
  ASSERT_EQ(run({"new", "mine/first"}), 0) << errors();
  EXPECT_EQ(run({"check", "mine/first"}), 0) << errors();
  std::ofstream(root_ / "mine/first/case.toml") << "# edited\n";
  EXPECT_EQ(run({"new", "mine/first"}), 2);
  EXPECT_EQ(read_file(root_ / "mine/first/case.toml"), "# edited\n");
}

TEST_F(LauncherFacts, CellOfASoil_IsPackedCompressedAndTold) {
  std::ofstream(root_ / "cell.toml")
      << "[soil]\nkind = \"dry\"\n[cell]\ngrains = 60\ncells = 2\nsteps = 500\npoints = 4\n";
  real_programs_ = true;
  ASSERT_EQ(run({"cell", "cell.toml", "--out", "cell", "--json"}), 0) << errors();
  const auto told = nlohmann::json::parse(output(), nullptr, false);
  ASSERT_TRUE(told.is_object()) << output();
  EXPECT_EQ(told["cells"], 2);
  EXPECT_EQ(told["points"].size(), 4u);
  for (const char* name : {"stress_strain.csv", "cells.csv", "cell.json", "case.resolved.toml"})
    EXPECT_TRUE(files::exists(root_ / "cell" / name)) << name;
  EXPECT_EQ(run({"cell", "cell.toml", "--out", "cell"}), 2) << "overwritten";
  EXPECT_EQ(run({"run", "cell.toml"}), 2) << "a unit cell is no scene";
}

TEST_F(LauncherFacts, NewWithoutFolder_PrintsTheCase) {
  ASSERT_EQ(run({"new"}), 0) << errors();
  std::ofstream(root_ / "printed.toml") << output();
  EXPECT_EQ(run({"check", "printed.toml"}), 0) << errors();
}

}  // namespace
}  // namespace standoff::launch
