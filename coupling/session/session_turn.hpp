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
void take_saved(SessionTurn& turn, Peer& peer, const message::Saved& saved);
void take_committed(SessionTurn& turn);
void start_windows(SessionTurn& turn);
/// Both sides wait at the end of a window: what comes next.
void go_on(SessionTurn& turn);
/// True if the sides were asked to save before window `next` is begun.
bool begin_checkpoint(SessionTurn& turn, std::int64_t next);
/// A signal: save first where that is possible.
void interrupt(SessionTurn& turn, const std::string& origin, const std::string& reason);
void watch(SessionTurn& turn);

}  // namespace standoff
