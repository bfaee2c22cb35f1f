// Law: inproc, ipc, tcp and tcp with CURVE are one thing to whoever uses them: the same values arrive, the same
// failures are found, the same words are said. Broker and participants are threads of this process. No tolerances.
#include <future>

#include <gtest/gtest.h>

#include "coupling/contract/surface_fields.hpp"
#include "coupling/transport/router.hpp"
#include "tests/contract/coupling_counting.hpp"
#include "tests/contract/coupling_raw_peer.hpp"

namespace standoff::test {
namespace {

struct End {
  int code = 0;
  std::string text;
};

class Transport : public testing::TestWithParam<const char*> {
 protected:
  Transport() {
    const std::string name = GetParam();
    run.broker.print = [this](const std::string& line) {
      const std::lock_guard guard(mutex);
      lines.push_back(nlohmann::json::parse(line));
    };
    if (name == "inproc") run.broker.listen = "inproc://" + run.folder;
    if (name == "tcp" || name == "curve") run.broker.listen = "tcp://127.0.0.1:*";
    if (name != "curve") return;
    for (const char* side : {"broker", "us"}) write_new_keys(run.folder + "/" + side);
    run.broker.keys = read_broker_keys(run.folder + "/broker.secret", run.folder + "/us.public");
    keys = read_participant_keys(run.folder + "/us.secret", run.folder + "/broker.public");
  }
  std::future<int> start_broker() {
    auto code = std::async(std::launch::async, [this] { return run_broker(run.broker); });
    eventually(10.0, [&] { return !first("listening").empty(); });
    return code;
  }
  nlohmann::json first(const std::string& kind) {
    const std::lock_guard guard(mutex);
    for (const auto& line : lines)
      if (line["event"] == kind) return line;
    return {};
  }
  ParticipantOptions options(Role role) {
    ParticipantOptions given = run.options(role);
    given.endpoint = first("listening")["endpoint"];
    given.keys = keys;
    given.end_process = [](ExitCode, const std::string&) {};
    return given;
  }
  static std::future<End> start(const ParticipantOptions& given, const std::function<void(Participant&)>& body) {
    return std::async(std::launch::async, [given, body]() -> End {
      try {
        with_link(given, body);
        return {};
      } catch (const Stop& stop) {
        return {static_cast<int>(stop.code()), stop.what()};
      }
    });
  }
  CoupledRun run;
  CurveKeys keys;
  std::mutex mutex;
  std::vector<nlohmann::json> lines;
};

TEST_P(Transport, TwoHundredWindows_EveryValueArrivesInOrder) {
  auto broker = start_broker();
  auto load = start(options(Role::load), count_load), structure = start(options(Role::structure), count_structure);
  EXPECT_EQ(load.get().text, "");
  EXPECT_EQ(structure.get().text, "");
  EXPECT_EQ(broker.get(), 0);
  EXPECT_EQ(first("interface")["impulse_given_Ns"], first("interface")["impulse_received_Ns"]);
}

TEST_P(Transport, GuardOfOneSide_IsTheFirstCauseOfAll) {
  auto broker = start_broker();
  auto load = start(options(Role::load), [](Participant& link) {
    idle_load(link, [](std::int64_t k) {
      if (k == 12) throw Stop(ExitCode::guard, "energy has grown");
    });
  });
  auto structure = start(options(Role::structure), [](Participant& link) { idle_structure(link); });
  for (const End& end : {load.get(), structure.get()}) {
    EXPECT_EQ(end.code, 3);
    EXPECT_EQ(end.text, "first cause: particles, window 12: energy has grown");
  }
  EXPECT_EQ(broker.get(), 3);
}

TEST_P(Transport, OneEndsWithoutAWord_TheBrokerSeesIt) {
  auto broker = start_broker();
  auto structure = start(options(Role::structure), [](Participant& link) { idle_structure(link); });
  ASSERT_TRUE(eventually(10.0, [&] { return !first("joined").empty(); }));
  {
    RawPeer peer(options(Role::load));
    peer.hello();
    peer.hear_a<message::Welcome>();
  }
  EXPECT_EQ(broker.get(), 4);
  EXPECT_TRUE(structure.get().text.starts_with("first cause: particles: the process ended without a goodbye"));
}

TEST_P(Transport, TheBrokerEndsWithoutAWord_AParticipantSeesIt) {
  const Endpoint endpoint = parse_endpoint(run.broker.listen, false);
  auto router = std::make_unique<Router>(endpoint, run.broker.keys);
  lines.push_back({{"event", "listening"}, {"endpoint", router->endpoint()}});
  auto load = start(options(Role::load), [](Participant& link) { idle_load(link); });
  ASSERT_TRUE(eventually(10.0, [&] { return router->receive().has_value(); }));
  router.reset();
  EXPECT_EQ(load.get().text, "first cause: broker: the process ended without a goodbye");
}

TEST_P(Transport, AnotherRunToken_IsTurnedAway) {
  auto broker = start_broker();
  ParticipantOptions stranger = options(Role::load);
  stranger.token = "bad";
  const End end = start(stranger, [](Participant& link) { idle_load(link); }).get();
  EXPECT_EQ(end.code, 2);
  EXPECT_NE(end.text.find("the run token is not the one of this broker"), std::string::npos) << end.text;
  auto load = start(options(Role::load), count_load), structure = start(options(Role::structure), count_structure);
  EXPECT_EQ(load.get().text + structure.get().text, "");
  EXPECT_EQ(broker.get(), 0);
}

TEST_P(Transport, FieldTruncated_EndsTheRunAndNamesTheField) {
  auto broker = start_broker();
  auto load = start(options(Role::load), [](Participant& link) { idle_load(link); });
  ASSERT_TRUE(eventually(10.0, [&] { return !first("joined").empty(); }));
  RawPeer peer(options(Role::structure));
  peer.hello();
  peer.hear_a<message::Welcome>();
  const Payload mesh = to_fields(strip(3));
  peer.say(message::Surface{8, 3, surface_digest(mesh)}, &mesh, [](Frames& frames) { spoil("truncate", frames); });
  EXPECT_NE(peer.hear_a<message::Abort>().reason.find("field \"node_mass\" announces 64 bytes, its frame holds 40"),
            std::string::npos);
  const End end = load.get();
  EXPECT_EQ(end.code, 4) << end.text;
  EXPECT_EQ(broker.get(), 4);
}

INSTANTIATE_TEST_SUITE_P(Each, Transport, testing::Values("inproc", "ipc", "tcp", "curve"),
                         [](const auto& given) { return std::string(given.param); });

}  // namespace
}  // namespace standoff::test
