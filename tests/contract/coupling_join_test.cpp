// Law: only the participants of this run get in; anyone else is told what is wrong and what to change, and the run goes
// on undisturbed. No tolerances.
#include <future>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "tests/contract/coupling_raw_peer.hpp"

namespace standoff::test {
namespace {

struct Refusal {
  const char* what;
  std::function<void(ParticipantOptions&)> change;
  const char* reason;
};

TEST(Join, WrongParticipants_AreRejectedWithAReasonAndTheRunGoesOn) {
  CoupledRun run;
  Child broker = run.start_broker();
  Child structure = run.start(run.options(Role::structure), [](Participant& link) { idle_structure(link); });
  ASSERT_TRUE(eventually(10.0, [&] { return !run.events("joined").empty(); }));
  const std::vector<Refusal> refusals = {
      {"token", [](auto& o) { o.token = "bad"; }, "run token"},
      {"case", [](auto& o) { o.case_hash = "other"; }, "case hash other differs from case of \"structure\""},
      {"name taken", [](auto& o) { o.name = "structure"; }, "a participant named \"structure\" has already joined"},
      {"name unknown", [](auto& o) { o.name = "sand"; }, "no participant named \"sand\" is expected"},
      {"role taken", [](auto& o) { o.role = Role::structure; }, "\"structure\" already is the structure side"}};
  for (const Refusal& refusal : refusals) {
    ParticipantOptions wrong = run.options(Role::load);
    refusal.change(wrong);
    Child child(run.error_file("wrong"),
                [&] { return participant_main("standoff-wrong", [&] { with_link(wrong, [](Participant&) {}); }); });
    EXPECT_EQ(child.wait(), 2) << refusal.what;
    EXPECT_NE(run.errors("wrong").find(refusal.reason), std::string::npos)
        << refusal.what << ": " << run.errors("wrong");
  }
  Child load = run.start(run.options(Role::load), [](Participant& link) { idle_load(link); });
  EXPECT_EQ(load.wait(), 0) << run.errors("particles");
  EXPECT_EQ(structure.wait(), 0) << run.errors("structure");
  EXPECT_EQ(broker.wait(), 0) << run.errors("broker");
  EXPECT_EQ(run.events("rejected").size(), refusals.size());
}

// The listener takes one connection, ends it in the middle of the greeting and is gone.
TEST(Join, BrokerThatDiesWhileItGreets_IsMissingAndNotAWrongKey) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&here), size), 0);
  ASSERT_EQ(listen(listener, 1), 0);
  ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&here), &size), 0);
  CoupledRun run;
  ParticipantOptions given = run.options(Role::load);
  given.endpoint = "tcp://127.0.0.1:" + std::to_string(ntohs(here.sin_port));
  given.join_deadline = 1.0;
  auto end = std::async(std::launch::async, [given]() -> std::pair<ExitCode, std::string> {
    try {
      with_link(given, [](Participant&) {});
    } catch (const Stop& stop) {
      return {stop.code(), stop.what()};
    }
    return {ExitCode::done, ""};
  });
  close(accept(listener, nullptr, nullptr));
  close(listener);
  const auto [code, text] = end.get();
  EXPECT_EQ(code, ExitCode::participant_lost) << text;
  EXPECT_TRUE(text.starts_with("no broker answered")) << text;
}

TEST(Join, AnotherWireVersion_IsRejectedWithBothVersions) {
  CoupledRun run;
  Child broker = run.start_broker();
  Child child(run.error_file("particles"), [&] {
    RawPeer peer(run.options(Role::load));
    peer.say(message::Hello{"particles", Role::load, "raw", "case", 1, "here"}, nullptr,
             [](Frames& frames) { edit_envelope(frames, [](wire::Envelope& e) { e.set_wire_version(9); }); });
    const auto reject = peer.hear_a<message::Reject>();
    std::fprintf(stderr, "%s; %s\n", reject.reason.c_str(), reject.remedy.c_str());
    return 0;
  });
  EXPECT_EQ(child.wait(), 0);
  EXPECT_NE(run.errors("particles").find("wire version 9 where this program speaks 1"), std::string::npos)
      << run.errors("particles");
}

TEST(Join, MessageBeforeHello_IsRejected) {
  CoupledRun run;
  Child broker = run.start_broker();
  Child child(run.error_file("particles"), [&] {
    RawPeer peer(run.options(Role::load));
    peer.say(message::Bye{});
    return peer.hear_a<message::Reject>().reason == "BYE before HELLO" ? 0 : 1;
  });
  EXPECT_EQ(child.wait(), 0) << run.errors("particles");
}

TEST(Join, NobodyComes_TheBrokerNamesTheMissing) {
  CoupledRun run;
  run.broker.rules.deadlines.join = 0.3;
  Child broker = run.start_broker();
  EXPECT_EQ(broker.wait(), 4);
  EXPECT_NE(run.cause("broker").find("\"particles\" did not join within 0.3 s"), std::string::npos)
      << run.cause("broker");
}

TEST(Join, BrokerStartedLater_ParticipantsWaitForIt) {
  CoupledRun run;
  Child load = run.start(run.options(Role::load), [](Participant& link) { idle_load(link); });
  Child structure = run.start(run.options(Role::structure), [](Participant& link) { idle_structure(link); });
  Child broker = run.start_broker();
  EXPECT_EQ(load.wait(), 0) << run.errors("particles");
  EXPECT_EQ(structure.wait(), 0) << run.errors("structure");
}

TEST(Join, NoBroker_TheParticipantSaysWhereItLooked) {
  CoupledRun run;
  ParticipantOptions options = run.options(Role::load);
  options.join_deadline = 0.3;
  Child load = run.start(options, [](Participant&) {});
  EXPECT_EQ(load.wait(), 4);
  EXPECT_NE(run.errors("particles").find("no broker answered at ipc://" + run.folder), std::string::npos);
}

TEST(Join, SecondBrokerOnALivePath_IsRefusedAndTheFirstLivesOn) {
  CoupledRun run;
  Child broker = run.start_broker();
  Child second(run.error_file("second"),
               [&] { return participant_main("standoff-broker", [&] { run_broker(run.broker); }); });
  EXPECT_EQ(second.wait(), 2);
  EXPECT_NE(run.errors("second").find("another broker listens on"), std::string::npos) << run.errors("second");
  EXPECT_TRUE(std::filesystem::exists(run.folder + "/broker"));
}

}  // namespace
}  // namespace standoff::test
