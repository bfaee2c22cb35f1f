#pragma once
// Where the broker listens: "ipc:///folder/name" (a socket file), "tcp://127.0.0.1:port" ("*" takes any free port), or
// "inproc://name" (threads of one process: tests, and programs that hold both solvers).
#include <string>

namespace standoff {

struct Endpoint {
  std::string text;  // as given
  std::string path;  // socket file of an ipc endpoint, else empty
  bool inproc = false;
  bool loopback = true;  // false: reachable from other machines
};

/// Throws Stop(bad_case) for anything else, for an ipc path longer than the system allows (107 characters), and for an
/// address beyond this machine unless `allowed`: there are keys (curve.hpp), or the user said --insecure.
Endpoint parse_endpoint(const std::string& text, bool allowed);

/// What to tell the user of a program that is alone in its process, where an inproc address leads nowhere; else empty.
std::string why_out_of_reach(const std::string& endpoint);

/// Keeps an ipc path for one broker: libzmq lets a second bind steal a live path. A file "PATH.lock" is locked for the
/// life of this object; it and the socket file are removed at its end.
class EndpointLock {
 public:
  explicit EndpointLock(const Endpoint& endpoint);  // throws Stop(bad_case) if another broker lives there
  ~EndpointLock();
  EndpointLock(const EndpointLock&) = delete;
  EndpointLock& operator=(const EndpointLock&) = delete;

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace standoff
