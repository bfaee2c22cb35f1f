// Law: a pipe holds a charge that fits into it, is meshed by equal quarters, and cannot hold sand. The case of the
// cylinder test is sound; each change that makes it impossible gives one error at the changed value.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/case_folder.hpp"

namespace standoff::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

CaseRead read_pipe(const std::string& key, const std::string& value) {
  CaseOverrides overrides = with_set({{key, value}});
  overrides.level = "small";
  return read_case(STANDOFF_SOURCE_DIR "/cases/borvik_2011/cylinder_test", overrides);
}

TEST(PipeChecks, EachImpossiblePipe_IsOneErrorAtTheValueThatMadeItSo) {
  const struct {
    const char *key, *value, *message;
  } mistakes[] = {
      {"plate.elements", "[6, 12, 1]", "6 elements round the pipe do not fill four equal quarters"},
      {"plate.elements", "[4, 13, 2]", "13 elements in a layer of the quarter do not fill fours"},
      {"plate.edges", "pinned", "pipe_hex64 does not know edges = \"pinned\""},
      {"plate.pipe.wall", "-1 mm", "out of range; wall > 0 m"},
      {"plate.pipe.length", "0 mm", "out of range; length > 0 m"},
      {"charge.radius", "13 mm", "the charge does not fit into the pipe: radius 13 mm against inner_diameter 25.43 mm"},
      {"charge.length", "310 mm", "the charge reaches out of the pipe: from z = -5 mm to 305 mm"},
      {"charge.mass", "1 kg", "the gas spheres do not fit into the charge"},
      {"run.symmetry", "none", "a pipe is computed as a quarter"},
      {"observe.probes", "[\"301 mm\"]", "a probe lies beyond the end of the pipe, 300 mm"}};
  for (const auto& mistake : mistakes) {
    const CaseRead result = read_pipe(mistake.key, mistake.value);
    ASSERT_EQ(result.errors.size(), 1u) << mistake.key << " = " << mistake.value << "\n" << all_errors(result);
    EXPECT_THAT(result.errors[0], StartsWith(std::string("--set ") + mistake.key + "=" + mistake.value + ": error: "));
    EXPECT_THAT(result.errors[0], HasSubstr(mistake.message));
  }
}

TEST(PipeChecks, LayersThatFillFours_AreSound) {
  EXPECT_EQ(all_errors(read_pipe("plate.elements", "[4, 12, 2]")), "");
  EXPECT_EQ(all_errors(read_pipe("plate.elements", "[8, 13, 1]")), "");
}

TEST(PipeChecks, EndsOfAPipe_AreFreeUnlessTheCaseHoldsThem) {
  EXPECT_EQ(read_pipe("run.seed", "1").spec.plate.edges, "free");
  for (const char* ends : {"free", "clamped", "symmetry"}) {
    const CaseRead held = read_pipe("plate.edges", ends);
    EXPECT_EQ(all_errors(held), "");
    EXPECT_EQ(held.spec.plate.edges, ends);
  }
}

}  // namespace
}  // namespace standoff::test
