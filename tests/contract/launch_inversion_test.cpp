// An element that turns inside out stops the run: exit 3, what and when in words, and the last sound shape as the last
// frame. A plate soft as rubber under the recorded load of tests/contract/tape cannot but fold through itself. The last
// frame is one step before the element broke: window 1 us, stable step above that, so exactly one window earlier.
#include <cmath>
#include <regex>

#include "tests/contract/launch_stage.hpp"

namespace standoff::launch {
namespace {

class InvertedRun : public LauncherStage {
 protected:
  InvertedRun() { real_programs_ = true; }
  static double number_after(const std::string& text, const std::string& pattern) {
    double last = std::nan("");
    const std::regex expression(pattern);
    for (std::sregex_iterator i(text.begin(), text.end(), expression), end; i != end; ++i) last = std::stod((*i)[1]);
    return last;
  }
};

TEST_F(InvertedRun, PlateSoftAsRubber_StopsWithExitThreeElementTimeAndTheLastSoundFrame) {
  const std::string fixture = STANDOFF_SOURCE_DIR "/tests/contract/tape";
  EXPECT_EQ(run({"run", fixture, "--particles", "replay:" + fixture + "/recorded.tape", "--out", "run", "--quiet",
                 "--checkpoint", "off", "--set", "plate.material.youngs_modulus=1 MPa", "--set",
                 "plate.material.A=0.01 MPa", "--set", "plate.material.B=0 Pa", "--set", "observe.snapshots=4"}),
            3);
  const auto j = record();
  EXPECT_EQ(j["status"], "failed") << j;
  EXPECT_EQ(j["exit_code"], 3) << j;
  const std::string said = errors(), series = read_file(root_ / "run/plate/plate.pvd");
  EXPECT_NE(said.find("plate element 0 turned inside out"), std::string::npos) << said;
  EXPECT_NE(said.find("the last sound shape is the last frame of plate/plate.pvd"), std::string::npos) << said;
  const double broken = number_after(said, "at t = ([0-9.e-]+) us"),
               shown = number_after(series, "timestep=\"([^\"]+)");
  EXPECT_NEAR(1e6 * shown, broken - 1.0, 1e-3) << "us\n" << said << series;
  expect_clean();
}

}  // namespace
}  // namespace standoff::launch
