#pragma once
// The broker's socket: ROUTER. Addresses are libzmq's own (a second peer with a chosen address would be dropped
// silently); a peer's end is seen through the socket monitor, matched by the descriptor its messages came in on.
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/transport/codec.hpp"
#include "coupling/transport/curve_keys.hpp"
#include "coupling/transport/endpoint.hpp"

namespace standoff {

class Router {
 public:
  /// Binds; throws Stop(bad_case) if that is not possible.
  explicit Router(const Endpoint& endpoint, const CurveKeys& keys = {});
  ~Router();
  Router(const Router&) = delete;
  Router& operator=(const Router&) = delete;

  /// With the port filled in.
  std::string endpoint() const;
  /// Returns when something is there, on a signal, or after `timeout`.
  void wait(std::chrono::milliseconds timeout);

  struct Arrival {
    std::string address;
    Frames frames;
  };
  std::optional<Arrival> receive();
  /// Addresses whose connection has ended since the last call. Take these first, then receive until empty, then
  /// believe them: a peer's last words are then never lost.
  std::vector<std::string> take_gone();
  enum class Delivery { sent, gone, full };  // full: the peer does not read its messages
  Delivery send(const std::string& address, Frames frames);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace standoff
