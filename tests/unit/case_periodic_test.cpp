// Law: a scene repeats after a width that somebody states, holds several particles between images, has no mirrors, and
// its plate is endless or stands free. Each wrong scene gives one error at the value that made it wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* domain = "[domain]\nboundaries = \"periodic\"\nsize = [\"500 mm\", \"500 mm\", \"1 m\"]\n";
constexpr const char* sand =
    "[soil]\nkind = \"dry\"\ninner_radius = \"30 mm\"\nouter_radius = \"76.2 mm\"\nparticles = 20_000\n";

std::string only_error(const std::string& more, std::vector<std::pair<std::string, std::string>> set) {
  CaseFolder folder;
  folder.write("case.toml", sound_case("symmetry = \"none\"\n" + more));
  const CaseRead read = folder.read("case.toml", with_set(std::move(set)));
  EXPECT_LE(read.errors.size(), 1u) << all_errors(read);
  return read.errors.empty() ? "" : read.errors[0];
}

TEST(PeriodicCase, RoomyAndWithoutMirrors_IsSound) {
  EXPECT_EQ(only_error(std::string(sand) + domain, {}), "");
  EXPECT_EQ(only_error(domain, {{"air.mode", "on"}}), "");
  EXPECT_EQ(only_error(domain, {{"plate.surround", "open"}}), "") << "plates with slots between them";
}

TEST(PeriodicCase, Quarter_IsRefusedWhereItIsStated) {
  const std::string error = only_error(domain, {{"run.symmetry", "quarter"}});
  EXPECT_THAT(error, StartsWith("--set run.symmetry=quarter: error: a scene that repeats has no mirror planes"));
  EXPECT_THAT(error, HasSubstr("symmetry = \"none\" in [run]"));
}

TEST(PeriodicCase, WidthNotStated_IsAskedForAtTheLineOfTheBoundaries) {
  const std::string error = only_error("[domain]\nboundaries = \"periodic\"\n", {});
  EXPECT_THAT(error, StartsWith("case.toml:10:14: error: "));
  EXPECT_THAT(error, HasSubstr("after which width is not stated"));
}

TEST(PeriodicCase, WidthThatIsWrong_IsOneMistake) {
  EXPECT_THAT(only_error("[domain]\nboundaries = \"periodic\"\nsize = [\"0 mm\", \"1 m\", \"1 m\"]\n", {}),
              HasSubstr("out of range"));
}

TEST(PeriodicCase, ImagesTooNear_AreRefusedWithTheRoomTheyNeed) {
  // 1.7e-3 m3 of sand, 60 % of it grains: a third of that is a grain of 87 mm.
  const std::string error = only_error(std::string(sand) + domain, {{"soil.particles", "3"}});
  EXPECT_THAT(error,
              StartsWith("--set soil.particles=3: error: the scene repeats after 500 mm, too soon for grains of"));
  EXPECT_THAT(error, HasSubstr("make the domain wider, or raise soil.particles"));
  EXPECT_THAT(only_error(domain, {{"air.mode", "on"}, {"air.particles", "200"}}),
              HasSubstr("too soon for cells of air"));
}

TEST(PeriodicCase, PlateThatEndsJustShortOfAFace_IsRefused) {
  EXPECT_THAT(only_error(domain, {{"plate.surround_size", "499 mm"}}), HasSubstr("from a face of the domain in x"));
  EXPECT_EQ(only_error(domain, {{"plate.surround_size", "500 mm"}}), "") << "reaches it";
}

}  // namespace
}  // namespace standoff::test
