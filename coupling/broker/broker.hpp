#pragma once
// The broker process: socket in, session (a pure function) in the middle, socket and event lines out. It is the clock
// and the referee; arrays pass through it untouched.
#include <functional>
#include <string>

#include "coupling/session/session.hpp"
#include "coupling/transport/curve_keys.hpp"

namespace standoff {

struct BrokerOptions {
  std::string listen;     // "ipc:///folder/name" or "tcp://127.0.0.1:port"
  bool insecure = false;  // allow an address that other machines can reach, unencrypted
  CurveKeys keys;         // with them the connection is encrypted and only known keys come in
  SessionRules rules;
  std::string build;                                   // names this program in a checkpoint
  std::string tape;                                    // file that every exchange is recorded in; empty: none
  std::function<void(const std::string& line)> print;  // one event line, without its end
};

/// Runs one session to its end. Returns the exit code of the run: 0, or that of the first failure.
/// Throws Stop(bad_case) if it cannot listen.
int run_broker(const BrokerOptions& options);

}  // namespace standoff
