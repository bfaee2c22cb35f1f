#pragma once
// CURVE on the sockets of this folder: encryption, and the gate that only lets known keys in.
#include <memory>
#include <string>
#include <vector>

#include <zmq.hpp>

#include "coupling/transport/curve_keys.hpp"

namespace standoff {

void use_as_server(zmq::socket_t& socket, const CurveKeys& keys);
void use_as_client(zmq::socket_t& socket, const CurveKeys& keys);

/// Answers libzmq's question whether a key may come in (ZAP, rfc.zeromq.org/spec/27) for the sockets of a context, in a
/// thread of its own. Exists before a socket binds, and ends before its context.
class KeyGate {
 public:
  KeyGate(zmq::context_t& context, std::vector<std::string> allowed);
  ~KeyGate();
  KeyGate(const KeyGate&) = delete;
  KeyGate& operator=(const KeyGate&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace standoff
