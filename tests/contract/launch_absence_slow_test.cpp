// Law: what is off is not there. With friction, air or heating off, the loop that the scene composes executes the
// instructions of a loop written by hand without them, to 1 % (the list of stages and their timers cost a few hundred
// instructions a step, of millions), and ends in the same bits. With the effect on, the count is higher by more than
// that: the measurement would notice. Instructions are counted by callgrind, so the clock does not matter.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

constexpr double most_difference = 0.01;

struct Count {
  std::string hash;
  double instructions = 0.0;
};

std::string output_of(const std::string& command) {
  std::string text;
  std::array<char, 4096> part{};
  FILE* pipe = popen(command.c_str(), "r");
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  if (pclose(pipe) != 0) ADD_FAILURE() << command << ":\n" << text;
  return text;
}

class Absence : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("valgrind --version > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "valgrind is missing; install it with: apt-get install valgrind";
  }
  /// Runs PROGRAM EFFECT HOW of a case under callgrind.
  Count count(const std::string& program, const std::string& effect, const std::string& how, const std::string& text) {
    folder_.write("case.toml", text);
    const std::string words = program + " " + effect + " " + how + " " + folder_.path() + "/case.toml";
    const std::string output = output_of(
        "OMP_NUM_THREADS=1 valgrind --tool=callgrind --callgrind-out-file=/dev/null "
        "--toggle-collect=measured " STANDOFF_BIN_DIR "/" +
        words + " 2>&1");
    Count found;
    const std::string label = "Collected : ";
    if (const auto at = output.find(label); at != std::string::npos)
      found.instructions = std::atof(output.c_str() + at + label.size());
    for (std::size_t begin = 0, end; (end = output.find('\n', begin)) != std::string::npos; begin = end + 1)
      if (output[begin] != '=') found.hash = output.substr(begin, end - begin);
    EXPECT_GT(found.instructions, 1e6) << output;
    EXPECT_EQ(found.hash.size(), 16u) << output;
    return found;
  }
  void compare(const std::string& program, const std::string& effect, const std::string& off, const std::string& on) {
    const Count composed = count(program, effect, "composed", off), by_hand = count(program, effect, "by_hand", off),
                with = count(program, effect, "composed", on);
    EXPECT_EQ(composed.hash, by_hand.hash);
    EXPECT_NEAR(composed.instructions / by_hand.instructions, 1.0, most_difference);
    EXPECT_GT(with.instructions / by_hand.instructions, 1.0 + 2.0 * most_difference);
    RecordProperty("composed_over_by_hand", std::to_string(composed.instructions / by_hand.instructions));
    std::printf("%s: composed %.0f, by hand %.0f, ratio %.5f; with it %.3f\n", effect.c_str(), composed.instructions,
                by_hand.instructions, composed.instructions / by_hand.instructions,
                with.instructions / by_hand.instructions);
  }

  CaseFolder folder_;
};

/// Few gas particles leave most of the work to the grains.
std::string particles_case(const std::string& friction, const std::string& air, int gas) {
  return R"([charge]
explosive = "c4"
mass = "150 g"
radius = "28.2 mm"
particles = )" +
         std::to_string(gas) + R"(
[plate]
material = "al6xn"
size = ["100 mm", "100 mm", "3.4 mm"]
[domain]
size = ["0.3 m", "0.3 m", "0.5 m"]
[run]
stand_off = "80 mm"
until = "0.3 ms"
symmetry = "quarter"
[soil]
kind = "dry"
inner_radius = "30 mm"
outer_radius = "76.2 mm"
particles = 3000
[air]
mode = ")" +
         air + "\"\n[effects]\nfriction = \"" + friction + "\"\n";
}

TEST_F(Absence, FrictionOff_IsALoopThatNeverKnewIt) {
  compare("absence_particles", "friction", particles_case("off", "off", 80), particles_case("on", "off", 80));
}

TEST_F(Absence, AirOff_IsALoopThatNeverKnewIt) {
  compare("absence_particles", "air", particles_case("off", "off", 800), particles_case("off", "on", 800));
}

std::string plate_case(const std::string& heating) {
  return R"([charge]
explosive = "c4"
mass = "150 g"
[plate]
material = "al6xn"
size = ["100 mm", "100 mm", "3.4 mm"]
elements = [4, 4, 1]
edges = "free"
[run]
stand_off = "150 mm"
settle = false
symmetry = "none"
[effects]
strain_rate = "on"
expansion = "off"
heating = ")" +
         heating + "\"\n";
}

TEST_F(Absence, HeatingOff_IsALoopThatNeverKnewIt) {
  compare("absence_plate", "heating", plate_case("off"), plate_case("on"));
}

}  // namespace
}  // namespace standoff::test
