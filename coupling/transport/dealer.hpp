#pragma once
// A participant's socket: DEALER. May be used from several threads, one at a time (the caller holds a lock).
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "coupling/transport/codec.hpp"
#include "coupling/transport/curve_keys.hpp"

namespace standoff {

class Dealer {
 public:
  /// Begins to connect and goes on trying: the broker may be started later. Throws Stop(bad_case) for an endpoint that
  /// cannot be one.
  explicit Dealer(const std::string& endpoint, const CurveKeys& keys = {}, bool insecure = false);
  ~Dealer();
  Dealer(const Dealer&) = delete;
  Dealer& operator=(const Dealer&) = delete;

  /// Returns when something is there, on a signal, or after `timeout`.
  void wait(std::chrono::milliseconds timeout);
  /// Takes note of connection events; ask `lost` after it, then receive until empty before believing it.
  void look();
  bool connected() const;
  /// The connection was there and has ended. It is not taken up again.
  bool lost() const;
  /// A broker is there and our keys and its keys do not fit, or only one side has keys.
  bool refused() const;

  std::optional<Frames> receive();
  /// False if the message could not be handed over within `timeout`.
  bool send(Frames frames, std::chrono::milliseconds timeout);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace standoff
