// From the first HELLO to the clock.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "coupling/session/session_turn.hpp"

namespace standoff {
namespace {

/// Why this HELLO cannot be accepted, and what to change; empty if it can.
std::pair<std::string, std::string> objection(SessionTurn& turn, const Envelope& envelope,
                                              const message::Hello& hello) {
  const SessionState& state = turn.state;
  const auto& expected = state.rules.expected;
  if (envelope.token != state.rules.token)
    return {"the run token is not the one of this broker", "give participant and broker the same --token"};
  if (std::find(expected.begin(), expected.end(), hello.name) == expected.end())
    return {fmt::format("no participant named \"{}\" is expected", hello.name),
            fmt::format("expected: {}; see --expect of the broker", fmt::join(expected, ", "))};
  for (const Peer& peer : state.peers) {
    if (peer.name == hello.name)
      return {fmt::format("a participant named \"{}\" has already joined: {}", hello.name, describe(peer)),
              "names are unique in a run; end the other process or start a new run"};
    if (peer.role == hello.role)
      return {fmt::format("\"{}\" already is the {} side", peer.name, role_name(peer.role)),
              "a run has one load side and one structure"};
  }
  // A program that does not read the case says nothing about it.
  if (!state.case_hash.empty() && !hello.case_hash.empty() && hello.case_hash != state.case_hash)
    return {fmt::format("case hash {} differs from {} of \"{}\"", hello.case_hash, state.case_hash,
                        state.peers.front().name),
            "start both with the same case, level and --set options"};
  if (state.rules.resume && !hello.keeps)
    return {"the run is continued from a checkpoint, and this participant cannot go on from one",
            "use the program that the run was begun with"};
  return {};
}

void forward_surface(SessionTurn& turn) {
  Peer* load = turn.with(Role::load);
  if (load == nullptr || load->stage != Stage::joined || turn.state.surface.nodes == 0) return;
  turn.send(*load, turn.state.surface, turn.state.surface_payload);
  turn.enter(*load, Stage::meshed);
}

void set_clock(SessionTurn& turn) {
  SessionState& state = turn.state;
  state.clock = decide_clock(state.rules.until, state.rules.parallel, state.rules.window, turn.with(Role::load)->needs,
                             turn.with(Role::structure)->needs);
}

/// The interface as it was when the checkpoint was made.
void take_up(SessionTurn& turn) {
  SessionState& state = turn.state;
  const InterfaceState& saved = state.rules.resume->state;
  if (saved.case_hash != state.case_hash || saved.surface_digest != state.surface.digest)
    throw Stop(ExitCode::checkpoint_incompatible,
               fmt::format("the checkpoint was written for case hash {} and surface {}, this run has {} and {}",
                           saved.case_hash, saved.surface_digest, state.case_hash, state.surface.digest));
  state.clock = saved.clock;
  state.bytes = saved.bytes;
  state.motion = saved.motion, state.load = saved.load;
  turn.with(Role::load)->totals = saved.given;
  turn.with(Role::structure)->totals = saved.received;
}

message::Start start_of(const SessionState& state, const Peer& peer) {
  message::Start start{state.clock, "", 0};
  if (!state.rules.resume) return start;
  start.folder = state.rules.resume->folder;
  for (const SavedSide& side : state.rules.resume->state.sides)
    if (side.name == peer.name) start.checksum = side.checksum;
  return start;
}

}  // namespace

void take_hello(SessionTurn& turn, const std::string& address, const Envelope& envelope, const message::Hello& hello) {
  const auto [reason, remedy] = objection(turn, envelope, hello);
  if (!reason.empty()) return turn.reject(address, hello.name, ExitCode::bad_case, reason, remedy);
  SessionState& state = turn.state;
  if (state.case_hash.empty()) state.case_hash = hello.case_hash;
  Peer peer;
  peer.address = address;
  peer.name = hello.name;
  peer.host = hello.host;
  peer.role = hello.role;
  peer.pid = hello.pid;
  peer.keeps = hello.keeps;
  peer.epoch = ++state.epochs;
  peer.received = envelope.sequence;
  peer.last_seen = turn.now;
  state.peers.push_back(std::move(peer));
  Peer& joined = state.peers.back();
  turn.enter(joined, Stage::joined);
  turn.announce(announce::Joined{joined.name, joined.role, joined.pid});
  turn.send(joined, message::Welcome{joined.epoch, state.rules.deadlines.beat_interval, state.rules.deadlines.beat});
  if (state.peers.size() == state.rules.expected.size()) state.phase_since = turn.now;
  forward_surface(turn);
}

void take_surface(SessionTurn& turn, Peer& peer, const Received& received) {
  const auto& surface = std::get<message::Surface>(received.body);
  if (peer.role != Role::structure) return turn.protocol_error(peer, "SURFACE from the load side");
  const std::vector<FieldShape> expected = {{"position", DataType::f64, 3, surface.nodes},
                                            {"quads", DataType::i32, 4, surface.quads},
                                            {"node_mass", DataType::f64, 1, surface.nodes}};
  if (surface.nodes <= 0 || surface.quads <= 0 || received.fields != expected)
    return turn.protocol_error(peer, fmt::format("SURFACE announces {} nodes and {} quads, its fields do not match",
                                                 surface.nodes, surface.quads));
  turn.state.surface = surface;
  turn.state.surface_payload = received.payload;
  turn.enter(peer, Stage::meshed);
  forward_surface(turn);
}

void take_ready(SessionTurn& turn, Peer& peer, const message::Ready& ready) {
  SessionState& state = turn.state;
  if (ready.surface_digest != state.surface.digest)
    return turn.protocol_error(peer, fmt::format("its surface has digest {}, the structure offered {}",
                                                 ready.surface_digest, state.surface.digest));
  peer.needs = ready.needs;
  turn.enter(peer, Stage::ready);
  const bool all =
      state.peers.size() == state.rules.expected.size() &&
      std::all_of(state.peers.begin(), state.peers.end(), [](const Peer& p) { return p.stage == Stage::ready; });
  if (!all) return;
  try {
    state.rules.resume ? take_up(turn) : set_clock(turn);
  } catch (const Stop& stop) {
    return turn.fail({"broker", stop.code(), stop.what(), -1});
  }
  turn.announce(announce::Clock{state.clock});
  for (Peer& each : state.peers) turn.send(each, start_of(state, each));
  start_windows(turn);
}

}  // namespace standoff
