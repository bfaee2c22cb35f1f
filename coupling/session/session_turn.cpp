#include "coupling/session/session_turn.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace standoff {

void SessionTurn::send(Peer& peer, Message body, PayloadHandle payload) {
  peer.last_sent = now;
  Envelope envelope{state.rules.token, peer.epoch, ++peer.sent, "broker", peer.window};
  actions.emplace_back(Send{peer.address, std::move(envelope), std::move(body), std::move(payload)});
}

void SessionTurn::announce(Announcement what) {
  actions.emplace_back(Announce{std::move(what)});
}

void SessionTurn::finish(ExitCode code) {
  actions.emplace_back(Finish{code});
}

void SessionTurn::enter(Peer& peer, Stage stage) {
  peer.stage = stage;
  peer.stage_since = peer.progress_since = now;
}

void SessionTurn::fail(message::Abort failure, const Peer* silent) {
  if (state.over) return;
  if (failure.code == ExitCode::done) failure.code = ExitCode::participant_lost;
  state.failure = failure;
  state.over = true;
  announce(announce::Failed{failure});
  for (Peer& peer : state.peers)
    if (peer.stage != Stage::closed && &peer != silent) send(peer, failure);
  finish(failure.code);
}

void SessionTurn::protocol_error(const Peer& peer, const std::string& reason) {
  fail({peer.name, ExitCode::participant_lost, "broke the protocol: " + reason, peer.window});
}

void SessionTurn::reject(const std::string& address, const std::string& name, ExitCode code, const std::string& reason,
                         const std::string& remedy) {
  Envelope envelope{"", 0, 1, "broker", -1};
  actions.emplace_back(Send{address, std::move(envelope), message::Reject{code, reason, remedy}, nullptr});
  announce(announce::Rejected{name, reason});
  state.turned_away = fmt::format("\"{}\" was turned away, {}; {}", name, reason, remedy);
}

Peer* SessionTurn::at(const std::string& address) {
  const auto found =
      std::find_if(state.peers.begin(), state.peers.end(), [&](const Peer& p) { return p.address == address; });
  return found == state.peers.end() ? nullptr : &*found;
}

Peer* SessionTurn::with(Role role) {
  const auto found =
      std::find_if(state.peers.begin(), state.peers.end(), [&](const Peer& p) { return p.role == role; });
  return found == state.peers.end() ? nullptr : &*found;
}

std::string describe(const Peer& peer) {
  std::string doing = stage_name(peer.stage);
  if (peer.stage == Stage::computing) doing += fmt::format(" window {}", peer.window);
  return fmt::format("{} (pid {} on {}), {}", peer.name, peer.pid, peer.host, doing);
}

}  // namespace standoff
