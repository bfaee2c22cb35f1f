// A plate that cannot be is refused before anything starts: exit 2, every diagnostic with file, line and column, no run
// folder; `check` and `run` say the same. Lines are counted in the case below.
#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

struct BadPlate {
  const char *line, *place, *says;
};

// The plate's table begins at line 4, what is wrong stands at line 9.
constexpr BadPlate bad_plates[] = {
    {"size = [\"406 mm\", \"406 mm\", \"-3.4 mm\"]", "case.toml:9:", "out of range"},
    {"elements = [10, 0, 1]", "case.toml:9:", "out of range"},
    {"elements = [5, 4, 1]", "case.toml:9:", "even numbers of elements"},
    {"model = \"plate_hex46\"", "case.toml:9:", "did you mean \"plate_hex64\""},
    {"edges = \"welded\"", "case.toml:9:", "clamped, pinned, free, symmetry, bolted"},
    {"edges = \"free\"", "case.toml:9:", "never comes to rest"},
    {"edges = \"symmetry\"", "case.toml:9:", "never comes to rest"},
    {"edges = \"bolted\"", "case.toml:4:", "opening is missing"},
    {"edges = \"bolted\"\nopening = \"500 mm\"", "case.toml:10:", "the frame does not reach the plate"},
    {"material = \"al7xn\"", "case.toml:9:", "did you mean \"al6xn\""},
    {"material.poissons_ratio = 0.5", "case.toml:9:", "out of range"},
    {"material.density = \"0 kg/m3\"", "case.toml:9:", "out of range"},
    {"material.melting_temperature = \"250 K\"", "case.toml:9:", "is not above room_temperature"}};

class LauncherBadPlate : public LauncherStage {};

/// Sound but for `line`, which takes the place of a line of the same key.
std::string case_with(const std::string& line) {
  const std::string key = line.substr(0, line.find_first_of(" ."));
  std::string text = "[case]\ntitle = \"a plate that cannot be\"\n\n[plate]\n";
  int lines = 0;
  for (const std::string sound : {"size = [\"406 mm\", \"406 mm\", \"3.4 mm\"]", "material.preset = \"al6xn\"",
                                  "elements = [4, 4, 1]", "model = \"plate_hex64\"", "edges = \"clamped\""}) {
    const bool replaced =
        sound.starts_with(key + " ") || (sound.starts_with("material") && line.starts_with("material ="));
    if (!replaced && lines < 4) text += sound + "\n", ++lines;
  }
  return text + line + "\n[run]\nuntil = \"1 ms\"\n";
}

TEST_F(LauncherBadPlate, EachMistakeAlone_IsRefusedWithItsPosition) {
  for (const BadPlate& bad : bad_plates) {
    std::ofstream(root_ / "case.toml") << case_with(bad.line);
    for (const char* verb : {"check", "run"}) {
      files::remove(root_ / "err.txt"), files::remove(root_ / "out.txt");
      std::vector<std::string> arguments{verb, "case.toml"};
      if (std::string(verb) == "run") arguments.insert(arguments.end(), {"--out", "never"});
      EXPECT_EQ(run(arguments), 2) << verb << "\n" << case_with(bad.line) << errors() << output();
      const std::string said = errors() + output();
      EXPECT_NE(said.find(bad.place), std::string::npos) << bad.line << "\n" << said;
      EXPECT_NE(said.find(bad.says), std::string::npos) << bad.line << "\n" << said;
      EXPECT_FALSE(files::exists(root_ / "never")) << bad.line;
    }
  }
}

}  // namespace
}  // namespace standoff::launch
