#pragma once
// One call of step_session in the making; shared by the files of this folder only.
#include "coupling/session/session.hpp"

namespace standoff {

struct SessionTurn {
  SessionState& state;
  double now;
  std::vector<SessionAction> actions{};

  void send(Peer& peer, Message body, PayloadHandle payload = nullptr);
  void announce(Announcement what);
  void finish(ExitCode code);
  void enter(Peer& peer, Stage stage);
  /// Ends the run: tells everyone but `silent` (who knows, or cannot hear). Only the first failure counts.
  void fail(message::Abort failure, const Peer* silent = nullptr);
  void protocol_error(const Peer& peer, const std::string& reason);
  void reject(const std::string& address, const std::string& name, ExitCode code, const std::string& reason,
              const std::string& remedy);

  Peer* at(const std::string& address);
  Peer* with(Role role);
};

/// "structure (pid 4711 on host), computing window 12".
std::string describe(const Peer& peer);

// By phase.
void take_hello(SessionTurn& turn, const std::string& address, const Envelope& envelope, const message::Hello& hello);
void take_surface(SessionTurn& turn, Peer& peer, const Received& received);
void take_ready(SessionTurn& turn, Peer& peer, const message::Ready& ready);
void take_advance(SessionTurn& turn, Peer& peer, const Received& received);
void take_stop(SessionTurn& turn, Peer& peer, const message::StopWindows& stop);
void take_bye(SessionTurn& turn, Peer& peer);
void start_windows(SessionTurn& turn);
void watch(SessionTurn& turn);

}  // namespace standoff
