// Law: sizes and values that come over the wire are not believed. Each spoilt message ends the run with code 4 and a
// first cause that says what was wrong with which field; a solver's own NaN is caught where it arises, with code 3.
#include <cmath>

#include <gtest/gtest.h>

#include "coupling/contract/surface_fields.hpp"
#include "tests/contract/coupling_raw_peer.hpp"

namespace standoff::test {
namespace {

/// The load side up to its first window, then one ADVANCE made by `advance`.
int misbehaving_load(const ParticipantOptions& options, const std::function<void(RawPeer&)>& advance) {
  RawPeer peer(options);
  peer.hello();
  peer.hear_a<message::Welcome>();
  const auto surface = peer.hear_a<message::Surface>();
  peer.say(message::Ready{{0.001, 0.0}, surface.digest});
  peer.hear_a<message::Start>();
  peer.hear_a<message::Grant>();
  advance(peer);
  Parcel parcel = peer.hear();  // what only the structure can see comes after the next grant
  if (std::holds_alternative<message::Grant>(parcel.body)) parcel = peer.hear();
  std::fprintf(stderr, "%s\n", first_cause(std::get<message::Abort>(parcel.body)).c_str());
  return 0;
}

struct Spoilt {
  const char* name;
  std::function<void(RawPeer&)> advance;
  const char* cause;
};

Payload forces(std::size_t nodes, double value = 1.0) {
  return to_fields(SurfaceLoad{std::vector<Vec3>(nodes, {0.0, 0.0, value})});
}

void say_spoilt(RawPeer& peer, Payload payload, const std::function<void(Frames&)>& change) {
  peer.say(message::Advance{}, &payload, change);
}

constexpr std::size_t nodes = 8;  // of strip(3)

const std::vector<Spoilt>& spoilt_messages() {
  static const std::vector<Spoilt> all = {
      {"Nan", [](RawPeer& p) { say_spoilt(p, forces(nodes, std::nan("")), nullptr); },
       "the load on the structure: field \"force\" is nan at item 0, component 2"},
      {"Truncated",
       [](RawPeer& p) { say_spoilt(p, forces(nodes), [](Frames& f) { f[1] = zmq::message_t(f[1].data(), 100); }); },
       "field \"force\" announces 192 bytes, its frame holds 100"},
      {"WrongCount", [](RawPeer& p) { say_spoilt(p, forces(nodes - 1), nullptr); },
       "ADVANCE must carry force for 8 nodes"},
      {"WrongChecksum",
       [](RawPeer& p) {
         say_spoilt(p, forces(nodes), [](Frames& f) {
           edit_envelope(f, [](wire::Envelope& e) { e.mutable_fields(0)->set_checksum(1); });
         });
       },
       "field \"force\" does not have the checksum"},
      {"HugeCount",
       [](RawPeer& p) {
         say_spoilt(p, forces(nodes), [](Frames& f) {
           edit_envelope(f, [](wire::Envelope& e) { e.mutable_fields(0)->set_count(~0ull); });
         });
       },
       "field \"force\" announces"},
      {"MissingFrame", [](RawPeer& p) { say_spoilt(p, forces(nodes), [](Frames& f) { f.pop_back(); }); },
       "1 fields announced, 0 frames"},
      {"Garbage", [](RawPeer& p) { say_spoilt(p, forces(nodes), [](Frames& f) { f[0] = zmq::message_t("?!", 2); }); },
       "the first frame is not an envelope"},
      {"WrongWindow",
       [](RawPeer& p) {
         const Payload payload = forces(nodes);
         message::Advance advance;
         advance.window = 7;
         p.say(advance, &payload);
       },
       "ADVANCE for window 7, granted was 0"},
      {"RanAhead", [](RawPeer& p) { p.say(message::Bye{}); }, "BYE while computing; expected"}};
  return all;
}

class SpoiltMessage : public testing::TestWithParam<std::size_t> {};

TEST_P(SpoiltMessage, FromAParticipant_EndsTheRunAndNamesTheField) {
  const Spoilt& spoilt = spoilt_messages()[GetParam()];
  CoupledRun run;
  Child broker = run.start_broker();
  Child structure = run.start(run.options(Role::structure), [](Participant& link) { idle_structure(link); });
  Child load(run.error_file("particles"), [&] { return misbehaving_load(run.options(Role::load), spoilt.advance); });
  EXPECT_EQ(broker.wait(), 4) << run.errors("broker");
  EXPECT_EQ(structure.wait(), 4) << run.errors("structure");
  EXPECT_EQ(load.wait(), 0) << run.errors("particles");
  EXPECT_NE(run.cause("broker").find(spoilt.cause), std::string::npos) << run.cause("broker");
  EXPECT_EQ(run.cause("structure"), run.cause("broker"));
  EXPECT_EQ(run.cause("particles"), run.cause("broker"));
}

INSTANTIATE_TEST_SUITE_P(Coupling, SpoiltMessage, testing::Range(std::size_t{0}, spoilt_messages().size()),
                         [](const auto& given) { return spoilt_messages()[given.param].name; });

TEST(SpoiltValue, FromOurOwnSolver_IsStoppedAtItsSource) {
  CoupledRun run;
  Child broker = run.start_broker();
  Child load = run.start(run.options(Role::load), [](Participant& link) { idle_load(link); });
  Child structure = run.start(run.options(Role::structure), [](Participant& link) {
    link.offer_surface(strip(3));
    link.ready({0.005, 0.0});
    SurfaceMotion motion{strip(3).position, strip(3).position};
    motion.velocity[5].y = INFINITY;
    link.next();
    link.advance(motion, {});
  });
  for (Child* child : {&broker, &load, &structure}) EXPECT_EQ(child->wait(), 3);
  EXPECT_NE(run.cause("particles").find("structure, window 0: surface velocity at node 5 is (0.2, inf, 0)"),
            std::string::npos)
      << run.cause("particles");
  EXPECT_EQ(run.cause("broker"), run.cause("particles"));
  EXPECT_EQ(run.cause("structure"), run.cause("particles"));
}

}  // namespace
}  // namespace standoff::test
