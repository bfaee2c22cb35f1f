// Checkpoints: both sides wait at the end of a window, save, and are let go once everything is on disk. An interrupted
// run goes on to the next such moment, saves and stops.
//
//   waiting --CHECKPOINT--> saving --SAVED (both)--> Commit -> Committed --> GRANT of the next window, or ABORT
#include <algorithm>

#include <fmt/format.h>

#include "coupling/session/session_turn.hpp"

namespace standoff {
namespace {

bool can_save(const SessionState& state) {
  return !state.rules.checkpoint.folder.empty() && !state.peers.empty() &&
         std::all_of(state.peers.begin(), state.peers.end(), [](const Peer& p) { return p.keeps; });
}

bool is_due(const SessionTurn& turn, std::int64_t next) {
  const SessionState& state = turn.state;
  const CheckpointRule& rule = state.rules.checkpoint;
  if (!state.stop_reason.empty() || next == state.clock.windows) return true;
  if (rule.every_windows > 0 && next % rule.every_windows == 0) return true;
  return rule.every > 0.0 && turn.now - state.last_checkpoint >= rule.every;
}

/// Both sides are between the first window and the last: there will be a moment to save.
bool in_windows(const SessionState& state) {
  return state.clock.windows > 0 && std::all_of(state.peers.begin(), state.peers.end(), [](const Peer& p) {
           return p.stage == Stage::computing || p.stage == Stage::waiting || p.stage == Stage::saving;
         });
}

void stop_now(SessionTurn& turn) {
  std::string reason = turn.state.stop_reason;
  if (turn.state.checkpoint > 0) reason += fmt::format("; a checkpoint holds {} windows", turn.state.checkpoint);
  const std::string& origin = turn.state.stop_origin;
  const auto peer =
      std::find_if(turn.state.peers.begin(), turn.state.peers.end(), [&](const Peer& p) { return p.name == origin; });
  turn.fail({origin, ExitCode::interrupted, reason, peer == turn.state.peers.end() ? -1 : peer->window});
}

}  // namespace

bool begin_checkpoint(SessionTurn& turn, std::int64_t next) {
  SessionState& state = turn.state;
  if (!can_save(state) || !is_due(turn, next)) return false;
  if (next == state.checkpoint) {  // it is there already
    if (state.stop_reason.empty()) return false;
    stop_now(turn);
    return true;
  }
  const std::string folder = fmt::format("{}/window-{:09}.part", state.rules.checkpoint.folder, next);
  for (Peer& peer : state.peers) {
    peer.saved.reset();
    turn.send(peer, message::Checkpoint{next, folder});
    turn.enter(peer, Stage::saving);
  }
  return true;
}

void take_saved(SessionTurn& turn, Peer& peer, const message::Saved& saved) {
  SessionState& state = turn.state;
  const std::int64_t windows = peer.window + 1;
  if (saved.windows != windows)
    return turn.protocol_error(peer, fmt::format("SAVED after {} windows, asked for {}", saved.windows, windows));
  if (peer.saved) return turn.protocol_error(peer, "SAVED twice");
  peer.saved = SavedSide{peer.name, saved.bytes, saved.checksum};
  if (!std::all_of(state.peers.begin(), state.peers.end(), [](const Peer& p) { return p.saved.has_value(); })) return;
  InterfaceState half{state.clock,
                      state.case_hash,
                      state.surface.digest,
                      turn.with(Role::load)->totals,
                      turn.with(Role::structure)->totals,
                      state.bytes,
                      state.motion,
                      state.load,
                      {}};
  half.clock.first = windows;
  for (const Peer& each : state.peers) half.sides.push_back(*each.saved);
  turn.actions.emplace_back(Commit{std::move(half)});
}

void take_committed(SessionTurn& turn) {
  SessionState& state = turn.state;
  announce::Checkpoint made;
  for (Peer& peer : state.peers) {
    made.windows = peer.window + 1;
    made.bytes += peer.saved->bytes;
    turn.enter(peer, Stage::waiting);
  }
  made.time = static_cast<double>(made.windows) * state.clock.window;
  state.checkpoint = made.windows;
  state.last_checkpoint = turn.now;
  turn.announce(made);
  if (state.stop_reason.empty())
    go_on(turn);
  else
    stop_now(turn);
}

void interrupt(SessionTurn& turn, const std::string& origin, const std::string& reason) {
  SessionState& state = turn.state;
  if (state.stop_reason.empty()) {
    state.stop_reason = reason;
    state.stop_origin = origin;
    state.stop_since = turn.now;
    if (can_save(state) && in_windows(state)) return turn.announce(announce::Saving{reason});
    return stop_now(turn);
  }
  if (turn.now - state.stop_since > state.rules.deadlines.save || !in_windows(state)) stop_now(turn);
}

}  // namespace standoff
