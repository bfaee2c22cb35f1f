// The real programs on a small case with sand: a result depends on the inputs alone. The same bits for a repeated run,
// for its resolved case and for any number of threads (fingerprint of both final states); another seed is another
// sample.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class RepeatedRun : public LauncherStage {
 protected:
  /// state_hash of a run with `more` options.
  std::string hash_of(const std::string& folder, const std::string& case_file, const std::vector<std::string>& more) {
    real_programs_ = true;
    std::vector<std::string> arguments{"run", case_file, "--out", folder, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    start(arguments);
    EXPECT_EQ(finish(120.0), 0) << errors();
    const auto j = nlohmann::json::parse(read_file(root_ / folder / "run.json"), nullptr, false);
    return j.is_object() ? j["provenance"].value("state_hash", "") : "";
  }
  const std::vector<std::string> sand{
      "--set", "soil.kind=dry",       "--set", "soil.inner_radius=30 mm", "--set", "soil.outer_radius=76.2 mm",
      "--set", "soil.particles=4000", "--set", "run.until=0.3 ms",        "--set", "run.settle=false"};
  std::vector<std::string> with(std::vector<std::string> more) const {
    more.insert(more.end(), sand.begin(), sand.end());
    return more;
  }
};

TEST_F(RepeatedRun, SameInputs_GiveTheSameBits) {
  const std::string one = hash_of("one", "case.toml", with({"--threads", "1"}));
  EXPECT_EQ(one.size(), 16u);
  EXPECT_EQ(hash_of("again", "case.toml", with({"--threads", "1"})), one);
  EXPECT_EQ(hash_of("two", "case.toml", with({"--threads", "2"})), one);
  EXPECT_EQ(hash_of("resolved", "one/case.resolved.toml", {}), one);
  EXPECT_NE(hash_of("seed", "case.toml", with({"--seed", "2"})), one);
}

}  // namespace
}  // namespace standoff::launch
