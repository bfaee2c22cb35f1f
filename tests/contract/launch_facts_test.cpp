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

TEST_F(LauncherFacts, NewWithoutFolder_PrintsTheCase) {
  ASSERT_EQ(run({"new"}), 0) << errors();
  std::ofstream(root_ / "printed.toml") << output();
  EXPECT_EQ(run({"check", "printed.toml"}), 0) << errors();
}

}  // namespace
}  // namespace standoff::launch
