#include "coupling/session/session.hpp"

#include <fmt/format.h>

#include "coupling/session/session_turn.hpp"

namespace standoff {
namespace {

/// Time and place are filled in for the load side, so that a progress line always says how far the run is.
void take_progress(SessionTurn& turn, const Peer& peer, NamedValues values) {
  const CouplingClock& clock = turn.state.clock;
  const auto missing = [&](const char* name) {
    for (const auto& value : values)
      if (value.first == name) return false;
    return true;
  };
  if (peer.role == Role::load) {
    const auto window = static_cast<double>(std::max<std::int64_t>(peer.window, 0));
    if (missing("time_s")) values.emplace_back("time_s", window * clock.window);
    if (missing("window")) values.emplace_back("window", window);
    if (missing("windows")) values.emplace_back("windows", static_cast<double>(clock.windows));
  }
  turn.announce(announce::Progress{peer.name, std::move(values)});
}

/// True if the message fits the connection and the stage of its sender.
bool is_legal(SessionTurn& turn, Peer& peer, const Received& received) {
  const Envelope& envelope = received.envelope;
  const char* name = message_name(received.body);
  if (envelope.token != turn.state.rules.token) {
    turn.protocol_error(peer, fmt::format("{} carries another run token", name));
  } else if (envelope.epoch != peer.epoch) {
    turn.protocol_error(peer, fmt::format("{} belongs to connection {}, this is {}", name, envelope.epoch, peer.epoch));
  } else if (envelope.sequence != peer.received + 1) {
    turn.protocol_error(peer, fmt::format("{} has sequence number {}, expected {}: a message was lost or repeated",
                                          name, envelope.sequence, peer.received + 1));
  } else if (!may_send(peer.stage, received.body.index())) {
    turn.protocol_error(peer,
                        fmt::format("{} while {}; expected {}", name, stage_name(peer.stage), expected_in(peer.stage)));
  }
  peer.received = envelope.sequence;
  return !turn.state.over;
}

struct Dispatch {
  SessionTurn& turn;
  Peer& peer;
  const Received& received;

  void operator()(const message::Surface&) { take_surface(turn, peer, received); }
  void operator()(const message::Ready& body) { take_ready(turn, peer, body); }
  void operator()(const message::Advance&) { take_advance(turn, peer, received); }
  void operator()(const message::StopWindows& body) { take_stop(turn, peer, body); }
  void operator()(const message::Beat& body) {
    if (body.progress != peer.progress) peer.progress_since = turn.now;
    peer.progress = body.progress;
  }
  void operator()(const message::Abort& body) {
    message::Abort failure = body;
    if (failure.origin.empty()) failure.origin = peer.name;
    turn.fail(std::move(failure));  // told to its sender too: that this was the first
  }
  void operator()(const message::Bye&) { take_bye(turn, peer); }
  void operator()(const message::Progress& body) {
    peer.progress_since = turn.now;
    take_progress(turn, peer, body.values);
  }
  void operator()(const message::Sample& body) {
    peer.progress_since = turn.now;
    turn.announce(announce::Sample{peer.name, body.time, body.values});
  }
  void operator()(const message::Report& body) { turn.announce(announce::Report{peer.name, body.json}); }
  void operator()(const message::Saved& body) { take_saved(turn, peer, body); }
  // The table of legal messages keeps these out.
  void operator()(const message::Hello&) {}
  void operator()(const message::Welcome&) {}
  void operator()(const message::Reject&) {}
  void operator()(const message::Start&) {}
  void operator()(const message::Grant&) {}
  void operator()(const message::ByeAck&) {}
  void operator()(const message::Checkpoint&) {}
};

struct Happened {
  SessionTurn& turn;

  void operator()(const Received& received) {
    Peer* peer = turn.at(received.address);
    if (peer == nullptr) {
      if (const auto* hello = std::get_if<message::Hello>(&received.body))
        return take_hello(turn, received.address, received.envelope, *hello);
      return turn.reject(received.address, received.envelope.sender, ExitCode::participant_lost,
                         fmt::format("{} before HELLO", message_name(received.body)),
                         "a connection opens with HELLO and is not taken up again after it was lost");
    }
    peer->last_seen = turn.now;
    if (!is_legal(turn, *peer, received)) return;
    turn.state.bytes += received.bytes;
    std::visit(Dispatch{turn, *peer, received}, received.body);
  }
  void operator()(const Malformed& event) {
    if (Peer* peer = turn.at(event.address))
      turn.protocol_error(*peer, event.reason);
    else
      turn.reject(event.address, "unknown", ExitCode::participant_lost, event.reason,
                  "use programs of the same release on both ends");
  }
  void operator()(const Disconnected& event) {
    const Peer* peer = turn.at(event.address);
    if (peer == nullptr || peer->stage == Stage::closed) return;
    turn.fail({peer->name, ExitCode::participant_lost,
               fmt::format("the process ended without a goodbye: {}", describe(*peer)), peer->window},
              peer);
  }
  void operator()(const Tick&) { watch(turn); }
  void operator()(const Interrupted& event) { interrupt(turn, "broker", event.reason); }
  void operator()(const Committed&) { take_committed(turn); }
  void operator()(const DiskFailed& event) { turn.fail({"broker", ExitCode::out_of_resources, event.reason, -1}); }
};

}  // namespace

SessionState open_session(SessionRules rules, double now) {
  SessionState state;
  state.rules = std::move(rules);
  state.phase_since = state.last_tick = state.last_notice = state.last_checkpoint = now;
  return state;
}

SessionStep step_session(SessionState state, const SessionEvent& event, double now) {
  SessionTurn turn{state, now};
  if (!state.over) std::visit(Happened{turn}, event);
  std::vector<SessionAction> actions = std::move(turn.actions);
  return {std::move(state), std::move(actions)};
}

}  // namespace standoff
