// Bodies of sand. Volumes are those of the solids; the share of random points of a box that a body takes must agree
// with them: the standard deviation of a share p of n points is sqrt(p (1 - p)/n), and five of them are allowed. Other
// tolerances are rounding of a few operations on lengths below 1 m: 1e-15.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "coupling/case/soil_body.hpp"
#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::HasSubstr;

constexpr Vec3 charge{0.0, 0.0, 0.15};

SoilSpec soil(SoilShape shape) {
  SoilSpec s;
  s.kind = SoilKind::dry, s.shape = shape, s.inner_radius = 0.03, s.outer_radius = 0.12, s.height = 0.1;
  s.size = {0.2, 0.3, 0.16}, s.centre = {0.01, -0.02, 0.16};
  return s;
}

constexpr SoilShape shapes[] = {SoilShape::shell, SoilShape::sphere, SoilShape::cylinder, SoilShape::box};

Vec3 random_point(CounterRandom& random) {
  const double x = random.uniform(), y = random.uniform(), z = random.uniform();
  return {0.4 * x - 0.2, 0.4 * y - 0.2, 0.4 * z - 0.05};
}

TEST(SoilBody, ShareOfRandomPoints_IsItsVolume) {
  constexpr int points = 200000;
  for (const SoilShape shape : shapes) {
    const SoilBody body(soil(shape), charge);
    int inside = 0;
    for (std::uint32_t n = 0; n < points; ++n) {
      CounterRandom random(1, RandomUse::test, n);
      inside += body.beyond(random_point(random)) < 0.0;
    }
    const double share = body.volume() / (0.4 * 0.4 * 0.4);
    EXPECT_NEAR(double(inside) / points, share, 5.0 * std::sqrt(share / points)) << "shape " << int(shape);
  }
}

TEST(SoilBody, PointHeldInside_LiesAtMostThePlayBeyondAndPointsInsideStay) {
  for (const SoilShape shape : shapes) {
    const SoilBody body(soil(shape), charge);
    for (std::uint32_t n = 0; n < 2000; ++n) {
      CounterRandom random(2, RandomUse::test, n);
      const Vec3 p = random_point(random), held = body.held(p, 0.001);
      EXPECT_LE(body.beyond(held), 0.001 + 1e-15);
      if (body.beyond(p) <= 0.001) {
        EXPECT_EQ(held, p);
      }
    }
  }
}

TEST(SoilBody, ShellLiesAboutTheCharge_OthersWhereStated) {
  EXPECT_EQ(SoilBody(soil(SoilShape::shell), charge).centre(), charge);
  EXPECT_EQ(SoilBody(soil(SoilShape::box), charge).centre(), (Vec3{0.01, -0.02, 0.16}));
  EXPECT_EQ(SoilBody(soil(SoilShape::cylinder), charge).half_size(), (Vec3{0.12, 0.12, 0.05}));
}

std::string read_soil(const std::string& keys, const std::string& more = "") {
  CaseFolder folder;
  folder.write("case.toml", sound_case(more + "[soil]\nkind = \"dry\"\n" + keys));
  return all_errors(folder.read());
}

TEST(SoilBodyInACase, ImpossibleBodies_AreOneErrorEach) {
  const std::string box = "body = \"box\"\nsize = [\"200 mm\", \"200 mm\", \"100 mm\"]\n",
                    hole = "inner_radius = \"30 mm\"\n";
  const std::pair<std::string, const char*> wrong[] = {
      {"body = \"box\"\n" + hole, "size is missing in [soil]; the body is a box"},
      {"body = \"cylinder\"\nouter_radius = \"90 mm\"\n" + hole, "height is missing in [soil]; the body is a cylinder"},
      {"body = \"sphere\"\n" + hole, "outer_radius is missing in [soil]; the body is a sphere"},
      {"outer_radius = \"76.2 mm\"\n", "inner_radius is missing in [soil]"},
      {box, "the charge is larger than its cavity: radius 28.17"},
      {box + hole + "centre = [\"0 mm\", \"0 mm\", \"220 mm\"]\n",
       "the cavity reaches out of the sand: its centre is -20 mm deep"},
      {box + hole + "centre = [\"0 mm\", \"0 mm\", \"175 mm\"]\n",
       "the cavity reaches out of the sand: its centre is 25 mm deep"},
      {box + "centre = [\"0 mm\", \"0 mm\", \"40 mm\"]\n",
       "the sand overlaps the plate: its lower end is at z = -10 mm"},
      {box + hole + "centre = [\"1 mm\", \"0 mm\", \"150 mm\"]\n",
       "quarter symmetry needs the centre of the sand on the z axis"},
      {"body = \"ball\"\n", "is not a choice here"}};
  for (const auto& [keys, message] : wrong) {
    const std::string errors = read_soil(keys);
    EXPECT_THAT(errors, HasSubstr(message)) << keys;
    EXPECT_EQ(errors.find("error:", errors.find("error:") + 1), std::string::npos) << errors;
  }
}

TEST(SoilBodyInACase, SoundBodies_AreRead) {
  const std::string box = "body = \"box\"\nsize = [\"200 mm\", \"200 mm\", \"100 mm\"]\n";
  EXPECT_EQ(read_soil(box + "inner_radius = \"30 mm\"\n"), "");
  EXPECT_EQ(read_soil(box + "centre = [\"0 mm\", \"0 mm\", \"50 mm\"]\n"), "") << "on the plate, the charge above it";
  EXPECT_EQ(read_soil("body = \"sphere\"\nouter_radius = \"40 mm\"\ncentre = [\"0 mm\", \"0 mm\", \"250 mm\"]\n"), "");
  EXPECT_EQ(read_soil("body = \"cylinder\"\nouter_radius = \"90 mm\"\nheight = \"80 mm\"\ninner_radius = \"30 mm\"\n"),
            "");
}

}  // namespace
}  // namespace standoff::test
