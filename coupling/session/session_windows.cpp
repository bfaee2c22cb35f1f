// The window clock. Parallel: both compute window k from what the other sent for k - 1, and the structure gets one
// window more (drain) so that the last load is applied. Serial: the load side first, then the structure with that load.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "coupling/session/session_turn.hpp"

namespace standoff {
namespace {

void grant(SessionTurn& turn, Peer& peer, std::int64_t window) {
  peer.window = window;
  SessionState& state = turn.state;
  message::Grant body;
  body.window = window;
  body.begin = static_cast<double>(window) * state.clock.window;
  body.drain = window == state.clock.windows;
  // What was granted is the receiver's alone: its memory is free again while it is still in the cache.
  turn.send(peer, body, std::exchange(peer.role == Role::load ? state.motion : state.load, nullptr));
  turn.enter(peer, Stage::computing);
}

void end_windows(SessionTurn& turn, Peer& peer) {
  turn.send(peer, message::StopWindows{turn.state.clock.windows, "all windows are done"});
  turn.enter(peer, Stage::finishing);
}

void next_parallel(SessionTurn& turn, Peer& load, Peer& structure) {
  const std::int64_t windows = turn.state.clock.windows;
  if (structure.stage != Stage::waiting) return;
  if (structure.window == windows) return end_windows(turn, structure);  // drained
  if (load.stage != Stage::waiting) return;
  const std::int64_t next = structure.window + 1;
  if (begin_checkpoint(turn, next)) return;
  grant(turn, structure, next);
  if (next < windows)
    grant(turn, load, next);
  else
    end_windows(turn, load);
}

void next_serial(SessionTurn& turn, Peer& load, Peer& structure) {
  const std::int64_t next = load.window + 1;
  if (load.stage != Stage::waiting || structure.stage != Stage::waiting) return;
  if (structure.window < load.window) return grant(turn, structure, load.window);
  if (begin_checkpoint(turn, next)) return;
  if (next < turn.state.clock.windows) return grant(turn, load, next);
  end_windows(turn, load);
  end_windows(turn, structure);
}

std::vector<FieldShape> fields_of(Role role, std::int64_t nodes) {
  if (role == Role::load) return {{"force", DataType::f64, 3, nodes}};
  return {{"position", DataType::f64, 3, nodes}, {"velocity", DataType::f64, 3, nodes}};
}

}  // namespace

void start_windows(SessionTurn& turn) {
  turn.state.last_checkpoint = turn.now;
  turn.state.checkpoint = turn.state.clock.first;  // there is nothing new to save yet
  for (Peer& peer : turn.state.peers) {
    peer.window = turn.state.clock.first - 1;
    turn.enter(peer, Stage::waiting);
  }
  go_on(turn);
}

void go_on(SessionTurn& turn) {
  Peer& load = *turn.with(Role::load);
  Peer& structure = *turn.with(Role::structure);
  turn.state.clock.parallel ? next_parallel(turn, load, structure) : next_serial(turn, load, structure);
}

void take_advance(SessionTurn& turn, Peer& peer, const Received& received) {
  SessionState& state = turn.state;
  const auto& advance = std::get<message::Advance>(received.body);
  if (advance.window != peer.window)
    return turn.protocol_error(peer, fmt::format("ADVANCE for window {}, granted was {}", advance.window, peer.window));
  if (received.fields != fields_of(peer.role, state.surface.nodes))
    return turn.protocol_error(
        peer, fmt::format("ADVANCE must carry {} for {} nodes; names, types or counts differ",
                          peer.role == Role::load ? "force" : "position and velocity", state.surface.nodes));
  (peer.role == Role::load ? state.load : state.motion) = received.payload;
  peer.totals = advance.totals;
  turn.enter(peer, Stage::waiting);
  go_on(turn);
}

void take_stop(SessionTurn& turn, Peer& peer, const message::StopWindows& stop) {
  if (stop.interrupted) return interrupt(turn, peer.name, stop.reason);
  CouplingClock& clock = turn.state.clock;
  std::int64_t granted = 0;
  for (const Peer& each : turn.state.peers) granted = std::max(granted, each.window + 1);
  if (granted >= clock.windows) return;  // the end is here already
  clock.windows = granted;
  turn.announce(announce::Stopping{peer.name, stop.reason, granted});
}

void take_bye(SessionTurn& turn, Peer& peer) {
  SessionState& state = turn.state;
  turn.send(peer, message::ByeAck{});
  turn.enter(peer, Stage::closed);
  const bool all =
      std::all_of(state.peers.begin(), state.peers.end(), [](const Peer& p) { return p.stage == Stage::closed; });
  if (!all) return;
  turn.announce(announce::Interface{state.bytes, turn.with(Role::load)->totals, turn.with(Role::structure)->totals});
  turn.announce(announce::Done{});
  state.over = true;
  turn.finish(ExitCode::done);
}

}  // namespace standoff
