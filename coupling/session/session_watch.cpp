// What time alone brings about. A dead process, a frozen one and a stuck solver are three things with three detectors:
// the connection (Disconnected), the silence, and a progress counter that stands still.
#include <algorithm>

#include <fmt/format.h>

#include "coupling/session/session_turn.hpp"

namespace standoff {
namespace {

/// True while the participant itself, and not its partner, holds up the run.
bool is_busy(const Peer& peer) {
  switch (peer.stage) {
    case Stage::joined:
      return peer.role == Role::structure;  // the load side waits for the surface
    case Stage::meshed:
    case Stage::computing:
    case Stage::finishing:
      return true;
    case Stage::saving:
      return !peer.saved.has_value();  // else it waits for the broker's disk
    default:
      return false;
  }
}

std::vector<std::string> missing_names(const SessionState& state) {
  std::vector<std::string> names;
  for (const std::string& name : state.rules.expected)
    if (std::none_of(state.peers.begin(), state.peers.end(), [&](const Peer& p) { return p.name == name; }))
      names.push_back(name);
  return names;
}

/// A broker that did not run (stopped by hand, a machine asleep) has seen nobody's beats: time it lost is not counted.
void forgive_own_pause(SessionTurn& turn) {
  SessionState& state = turn.state;
  const double pause = turn.now - state.last_tick;
  state.last_tick = turn.now;
  if (pause <= state.rules.deadlines.own_pause) return;
  state.phase_since += pause;
  for (Peer& peer : state.peers) {
    peer.last_seen = std::min(turn.now, peer.last_seen + pause);
    peer.progress_since = std::min(turn.now, peer.progress_since + pause);
  }
}

void check_deadlines(SessionTurn& turn) {
  SessionState& state = turn.state;
  const Deadlines& limit = state.rules.deadlines;
  const std::vector<std::string> missing = missing_names(state);
  if (!missing.empty() && turn.now - state.phase_since > limit.join)
    return turn.fail({"broker", ExitCode::participant_lost,
                      fmt::format("\"{}\" did not join within {:g} s: {}", missing.front(), limit.join,
                                  state.turned_away.empty() ? "see its own messages, or start it with the endpoint and "
                                                              "token of this broker"
                                                            : state.turned_away),
                      -1});
  for (const Peer& peer : state.peers) {
    if (peer.stage == Stage::closed) continue;
    if (turn.now - peer.last_seen > limit.beat)
      return turn.fail({peer.name, ExitCode::participant_lost,
                        fmt::format("no sign of life for {:g} s: {}; the process is frozen or its host is cut off",
                                    limit.beat, describe(peer)),
                        peer.window});
    if (limit.progress > 0.0 && is_busy(peer) && turn.now - peer.progress_since > limit.progress)
      return turn.fail({peer.name, ExitCode::participant_lost,
                        fmt::format("no progress for {:g} s: {}; its solver is stuck (or slow: raise "
                                    "--progress-deadline)",
                                    limit.progress, describe(peer)),
                        peer.window});
  }
}

/// Both sides have saved, and the broker's half is not on disk yet.
bool broker_is_writing(const SessionState& state) {
  return !state.peers.empty() && std::all_of(state.peers.begin(), state.peers.end(), [](const Peer& peer) {
    return peer.stage == Stage::saving && peer.saved.has_value();
  });
}

void notice_waiting(SessionTurn& turn) {
  SessionState& state = turn.state;
  announce::Waiting waiting;
  waiting.names = missing_names(state);
  double begin = state.phase_since;
  for (const std::string& name : waiting.names) waiting.stage += name + ": not here yet; ";
  if (state.clock.windows > 0) {
    begin = turn.now;
    for (const Peer& peer : state.peers)
      if (peer.stage == Stage::waiting || peer.stage == Stage::saving) begin = std::min(begin, peer.stage_since);
  }
  if (broker_is_writing(state)) {
    waiting.names.push_back("broker");
    waiting.stage += "broker: writing a checkpoint; ";
  }
  for (const Peer& peer : state.peers) {
    if (!is_busy(peer)) continue;
    waiting.names.push_back(peer.name);
    waiting.stage += describe(peer) + "; ";
  }
  waiting.since = turn.now - begin;
  if (waiting.names.empty() || waiting.since < state.rules.deadlines.notice) return;
  if (turn.now - state.last_notice < state.rules.deadlines.notice) return;
  waiting.stage.resize(waiting.stage.size() - 2);
  state.last_notice = turn.now;
  turn.announce(std::move(waiting));
}

}  // namespace

void watch(SessionTurn& turn) {
  forgive_own_pause(turn);
  check_deadlines(turn);
  if (turn.state.over) return;
  if (!turn.state.stop_reason.empty()) interrupt(turn, turn.state.stop_origin, turn.state.stop_reason);
  if (turn.state.over) return;
  notice_waiting(turn);
  for (Peer& peer : turn.state.peers)
    if (peer.stage != Stage::closed && turn.now - peer.last_sent >= turn.state.rules.deadlines.beat_interval)
      turn.send(peer, message::Beat{});
}

}  // namespace standoff
