#pragma once
// The event stream of a socket: connections that were made and that ended. Used by the sockets of this folder only.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <zmq.hpp>

#include "coupling/transport/endpoint.hpp"

namespace standoff {

struct ConnectionEvent {
  /// refused: our keys were looked at and turned down; broken: the greeting failed for want of keys that fit, or
  /// because the other side ended in the middle of it.
  enum class Kind { opened, ended, refused, broken };
  Kind kind = Kind::ended;
  int descriptor = -1;
};

/// Both ends of an inproc endpoint must live in one context, each other end in its own.
std::shared_ptr<zmq::context_t> context_for(const Endpoint& endpoint);
/// On inproc there is no connection that could end: who leaves says so with an empty message.
bool is_farewell(const std::vector<zmq::message_t>& frames);
void send_farewell(zmq::socket_t& socket, const std::string& address = {});

class SocketWatch {
 public:
  SocketWatch(zmq::context_t& context, zmq::socket_t& socket);
  ~SocketWatch();
  SocketWatch(const SocketWatch&) = delete;
  SocketWatch& operator=(const SocketWatch&) = delete;

  std::optional<ConnectionEvent> next();
  /// Returns when there is a message or an event, on a signal, or after `milliseconds`. Whoever has just found no
  /// message says so: `empty`.
  void wait(long milliseconds, bool empty);

 private:
  zmq::socket_t& socket_;
  zmq::socket_t events_;
  bool empty_ = false;  // the last look found no event
  bool quiet_ = false;  // the wait just ended, not by an event: that need not be asked again
};

/// Hands a frame over; a signal in the middle is no failure. False: zmq_errno says why.
bool send_frame(zmq::message_t& frame, zmq::socket_t& socket, int flags);
/// All frames of the next message, or nothing if none is there.
std::optional<std::vector<zmq::message_t>> receive_frames(zmq::socket_t& socket);
/// Returns when either socket can be read, on a signal, or after `milliseconds`.
void wait_for_input(zmq::socket_t& one, zmq::socket_t& other, long milliseconds);

}  // namespace standoff
