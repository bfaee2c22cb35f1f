#pragma once
// The event stream of a socket: connections that were made and that ended. Used by the sockets of this folder only.
#include <cstdint>
#include <optional>
#include <string>

#include <zmq.hpp>

namespace standoff {

struct ConnectionEvent {
  bool opened = false;  // otherwise it ended
  int descriptor = -1;
};

class SocketWatch {
 public:
  SocketWatch(zmq::context_t& context, zmq::socket_t& socket);
  ~SocketWatch();
  SocketWatch(const SocketWatch&) = delete;
  SocketWatch& operator=(const SocketWatch&) = delete;

  std::optional<ConnectionEvent> next();
  zmq::socket_t& events() { return events_; }

 private:
  zmq::socket_t& socket_;
  zmq::socket_t events_;
};

/// All frames of the next message, or nothing if none is there.
std::optional<std::vector<zmq::message_t>> receive_frames(zmq::socket_t& socket);
/// Returns when either socket can be read, on a signal, or after `milliseconds`.
void wait_for_input(zmq::socket_t& socket, zmq::socket_t& events, long milliseconds);

}  // namespace standoff
