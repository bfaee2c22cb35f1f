// Law: the protocol is a table of (stage, message). A legal message moves the sender to the stage named here or leaves
// it; every other one ends the run with code 4, is told to both sides, and names the message, the stage and what was
// expected. All 9 x 18 pairs are tried for the load side and for the structure. No tolerances.
#include <map>

#include <gtest/gtest.h>

#include "tests/unit/coupling_virtual_session.hpp"

namespace standoff::test {
namespace {

const std::vector<FieldShape> surface_fields = {
    {"position", DataType::f64, 3, 2}, {"quads", DataType::i32, 4, 1}, {"node_mass", DataType::f64, 1, 2}};

/// A well-formed message of every kind, as `name` would send it in window 0.
std::vector<std::pair<Message, std::vector<FieldShape>>> one_of_each(const std::string& name) {
  const std::vector<FieldShape> force = {{"force", DataType::f64, 3, 2}};
  const std::vector<FieldShape> motion = {{"position", DataType::f64, 3, 2}, {"velocity", DataType::f64, 3, 2}};
  const bool load = name == "particles";
  return {{message::Hello{name, load ? Role::load : Role::structure, "v", "case", 1, "host"}, {}},
          {message::Welcome{}, {}},
          {message::Reject{}, {}},
          {message::Surface{2, 1, "digest"}, surface_fields},
          {message::Ready{{0.25, 0.0}, "digest"}, {}},
          {message::Start{}, {}},
          {message::Grant{}, {}},
          {message::Advance{}, load ? force : motion},
          {message::StopWindows{0, "enough"}, {}},
          {message::Beat{1}, {}},
          {message::Abort{name, ExitCode::guard, "unstable", 0}, {}},
          {message::Bye{}, {}},
          {message::ByeAck{}, {}},
          {message::Progress{}, {}},
          {message::Sample{}, {}},
          {message::Report{"{}"}, {}},
          {message::Checkpoint{}, {}},
          {message::Saved{1, 8, 0}, {}}};
}

/// Brings `name` into `stage`; the partner is where the protocol then puts it.
VirtualSession session_in(Stage stage, const std::string& name) {
  const bool load = name == "particles";
  const std::string other = load ? "structure" : "particles";
  SessionRules rules = VirtualSession::default_rules();
  if (stage == Stage::saving) rules.checkpoint = {"/run/checkpoint", 0.0, 1};
  VirtualSession run(rules);
  if (stage == Stage::absent) return run;
  run.join(name, load ? Role::load : Role::structure);
  if (stage == Stage::joined) return run;
  run.join(other, load ? Role::structure : Role::load);
  run.offer_surface();
  if (stage == Stage::meshed) return run;
  run.ready(name);
  if (stage == Stage::ready) return run;
  run.ready(other);
  if (stage == Stage::computing) return run;
  run.advance(name, 0);
  if (stage == Stage::waiting) return run;
  run.advance(other, 0);
  if (stage == Stage::saving) return run;
  for (std::int64_t k = 1; k < 4; ++k) run.advance("particles", k), run.advance("structure", k);
  run.advance("structure", 4);  // drain
  if (stage == Stage::finishing) return run;
  run.say(name, message::Bye{});
  return run;
}

/// Where a legal message leads; not listed: the stage stays.
Stage after(Stage stage, const std::string& kind) {
  static const std::map<std::string, Stage> next = {{"HELLO", Stage::joined},
                                                    {"SURFACE", Stage::meshed},
                                                    {"READY", Stage::ready},
                                                    {"ADVANCE", Stage::waiting},
                                                    {"BYE", Stage::closed}};
  return next.contains(kind) ? next.at(kind) : stage;
}

class SessionTable : public testing::TestWithParam<std::tuple<std::size_t, std::string>> {};

TEST_P(SessionTable, EveryMessage_IsTakenAsTheTableSaysOrEndsTheRun) {
  const Stage stage = static_cast<Stage>(std::get<0>(GetParam()));
  const std::string name = std::get<1>(GetParam());
  const auto messages = one_of_each(name);
  ASSERT_EQ(messages.size(), message_kinds);
  for (std::size_t kind = 0; kind < message_kinds; ++kind) {
    ASSERT_EQ(messages[kind].first.index(), kind);
    const std::string what = message_name(kind);
    VirtualSession run = session_in(stage, name);
    ASSERT_EQ(run.stage(name), stage);
    ASSERT_EQ(run.cause(), "none");
    run.actions.clear();
    run.say(name, messages[kind].first, messages[kind].second);
    const bool surface_of_the_load_side = what == "SURFACE" && name == "particles";
    if (stage == Stage::absent && what != "HELLO") {
      EXPECT_EQ(run.sent<message::Reject>(name).size(), 1u) << what;
      EXPECT_FALSE(run.state.over) << what;
    } else if (may_send(stage, kind) && what != "ABORT" && !surface_of_the_load_side) {
      EXPECT_EQ(run.cause(), "none") << what << " while " << stage_name(stage);
      EXPECT_EQ(run.stage(name), after(stage, what)) << what << " while " << stage_name(stage);
    } else {
      const bool aborted = what == "ABORT" && stage != Stage::closed;
      EXPECT_EQ(run.finished(), std::vector<int>{aborted ? 3 : 4}) << what << " while " << stage_name(stage);
      EXPECT_EQ(run.announced<announce::Failed>().size(), 1u);
      if (!aborted && !surface_of_the_load_side) {
        const std::string expected = what + " while " + stage_name(stage) + "; expected " + expected_in(stage);
        EXPECT_NE(run.cause().find(expected), std::string::npos) << run.cause();
      }
      const std::string other = name == "particles" ? "structure" : "particles";
      EXPECT_EQ(run.sent<message::Abort>(other).size(), run.find(other) ? 1u : 0u) << what;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Coupling, SessionTable,
                         testing::Combine(testing::Range(std::size_t{0}, stage_count),
                                          testing::Values("particles", "structure")),
                         [](const auto& given) {
                           return std::string(stage_name(static_cast<Stage>(std::get<0>(given.param)))) + "_" +
                                  std::get<1>(given.param);
                         });

}  // namespace
}  // namespace standoff::test
