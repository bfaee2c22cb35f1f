// A scene that cannot be (contract, sec. 3): every mistake at once with file, line and column, exit code 2, nothing
// started, no folder made. One row a mistake: what is written there and the start of what is said about it. The column
// is that of the value that made the scene impossible, so it follows from the text; no tolerance.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

struct Line {
  const char* text;
  const char* error;  // nullptr: nothing is wrong here
};

class ImpossibleScene : public LauncherStage {
 protected:
  /// Writes bad.toml, runs `verb` on it and looks for each error at its place, and for no other.
  void expect_all_reported(const char* verb, const std::vector<Line>& lines) {
    std::ofstream(root_ / "err.txt");
    std::ofstream file(root_ / "bad.toml");
    for (const Line& line : lines) file << line.text << "\n";
    file.close();
    std::vector<std::string> arguments{verb, "bad.toml"};
    if (std::string(verb) == "run") arguments.insert(arguments.end(), {"--out", "run"});
    EXPECT_EQ(run(arguments), 2) << verb;
    const std::string said = errors() + output();
    std::size_t mistakes = 0;
    for (std::size_t n = 0; n < lines.size(); ++n) {
      if (!lines[n].error) continue;
      ++mistakes;
      const std::size_t column = std::string(lines[n].text).find("= ") + 3;
      const std::string expected =
          "bad.toml:" + std::to_string(n + 1) + ":" + std::to_string(column) + ": error: " + lines[n].error;
      EXPECT_NE(said.find(expected), std::string::npos) << verb << ": " << expected << " is not in " << said;
    }
    std::size_t found = 0;
    for (std::size_t at = 0; (at = said.find(": error: ", at)) != std::string::npos; ++at) ++found;
    EXPECT_EQ(found, mistakes) << said;
    EXPECT_TRUE(stand_ins().empty()) << "a program was started";
    EXPECT_FALSE(files::exists(root_ / "run"));
    expect_clean();
  }
};

TEST_F(ImpossibleScene, BodiesAndSpheres_AreAllReportedBeforeAnythingStarts) {
  const std::vector<Line> lines{
      {"[charge]", nullptr},
      {"mass = \"150 g\"", nullptr},
      {"explosive = { preset = \"c4\" }", nullptr},
      {"radius = \"31 mm\"", "the charge is larger than its cavity: radius 31 mm against inner_radius 30 mm"},
      {"detonator = [\"0 mm\", \"0 mm\", \"200 mm\"]", "the detonator is outside the charge: "},
      {"[soil]", nullptr},
      {"kind = \"dry\"", nullptr},
      {"packing = 0.75", "packing = 0.75 is out of range; 0 < packing <= 0.74"},
      {"inner_radius = \"30 mm\"", nullptr},
      {"outer_radius = \"76.2 mm\"", nullptr},
      {"radius_spread = 1.5", "radius_spread = 1.5 is out of range; 0 <= radius_spread <= 0.5"},
      {"[contact]", nullptr},
      {"surface_friction = 2.0", "surface_friction = 2 is out of range; 0 <= surface_friction <= 1"},
      {"[plate]", nullptr},
      {"material = \"al6xn\"", nullptr},
      {"size = [\"406 mm\", \"406 mm\", \"3.4 mm\"]", nullptr},
      {"[domain]", nullptr},
      {"size = [\"0.3 m\", \"1 m\", \"1 m\"]",
       "the domain is smaller than the scene: x from -150 mm to 150 mm, the plate"},
      {"[run]", nullptr},
      {"stand_off = \"70 mm\"", "the sand overlaps the plate: stand_off 70 mm is smaller than its radius 76.2 mm"}};
  for (const char* verb : {"check", "plan", "run"}) expect_all_reported(verb, lines);
}

TEST_F(ImpossibleScene, NegativeFillAndChargeInThePlate_AreAllReportedBeforeAnythingStarts) {
  const std::vector<Line> lines{
      {"[charge]", nullptr},
      {"mass = \"150 g\"", nullptr},
      {"[charge.explosive]", nullptr},
      {"preset = \"c4\"", nullptr},
      {"fill = -0.1", "fill = -0.1 is out of range; 0 <= fill <= 0.74"},
      {"[plate]", nullptr},
      {"material = \"al6xn\"", nullptr},
      {"size = [\"406 mm\", \"406 mm\", \"3.4 mm\"]", nullptr},
      {"[run]", nullptr},
      {"stand_off = \"20 mm\"", "the charge overlaps the plate: stand_off 20 mm is smaller than its radius 28.17"}};
  for (const char* verb : {"check", "run"}) expect_all_reported(verb, lines);
}

TEST_F(ImpossibleScene, SpheresThatCannotFit_AreReportedAtTheCharge) {
  const std::vector<Line> lines{
      {"[charge]", nullptr},
      {"mass = \"150 g\"", nullptr},
      {"radius = \"15 mm\"", "the gas spheres do not fit into the charge: they would fill 1.33"},
      {"[plate]", nullptr},
      {"material = \"al6xn\"", nullptr},
      {"size = [\"406 mm\", \"406 mm\", \"3.4 mm\"]", nullptr},
      {"[run]", nullptr},
      {"stand_off = \"150 mm\"", nullptr}};
  expect_all_reported("run", lines);
}

}  // namespace
}  // namespace standoff::launch
