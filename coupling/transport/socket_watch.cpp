#include "coupling/transport/socket_watch.hpp"

#include <atomic>
#include <cstring>
#include <mutex>
#include <utility>

#include <poll.h>

namespace standoff {
namespace {

constexpr int handshake_broken = ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL;

constexpr std::size_t usual_frames = 4;  // address, envelope, two arrays

std::string fresh_name() {
  static std::atomic<unsigned> count{0};
  return "inproc://watch-" + std::to_string(count++);
}

/// True, too, if a signal came: it ends a wait.
bool may_be_read(zmq::socket_t& socket) {
  int events = 0;
  std::size_t size = sizeof events;
  return zmq_getsockopt(socket.handle(), ZMQ_EVENTS, &events, &size) != 0 || (events & ZMQ_POLLIN) != 0;
}

/// Waits for the descriptors, which tell only of what came since their sockets were last found empty; sending looks,
/// too.
bool second_is_told_of(zmq::socket_t& first, zmq::socket_t& second, long milliseconds) {
  pollfd descriptors[] = {{first.get(zmq::sockopt::fd), POLLIN, 0}, {second.get(zmq::sockopt::fd), POLLIN, 0}};
  poll(descriptors, 2, static_cast<int>(milliseconds));
  return descriptors[1].revents != 0;
}

}  // namespace

SocketWatch::SocketWatch(zmq::context_t& context, zmq::socket_t& socket)
    : socket_(socket), events_(context, zmq::socket_type::pair) {
  const std::string name = fresh_name();
  constexpr int wanted =
      ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED | ZMQ_EVENT_HANDSHAKE_FAILED_AUTH | handshake_broken;
  if (zmq_socket_monitor(socket.handle(), name.c_str(), wanted) != 0) throw zmq::error_t();
  events_.set(zmq::sockopt::linger, 0);
  events_.connect(name);
}

SocketWatch::~SocketWatch() {
  zmq_socket_monitor(socket_.handle(), nullptr, 0);
}

void SocketWatch::wait(long milliseconds, bool empty) {
  // What was just found empty is not asked again: zmq_poll does the same with four times the calls of the system.
  const bool there = (!empty && may_be_read(socket_)) || (!empty_ && may_be_read(events_));
  quiet_ = !there && !second_is_told_of(socket_, events_, milliseconds);
}

std::optional<ConnectionEvent> SocketWatch::next() {
  if (std::exchange(quiet_, false)) return std::nullopt;
  // Two frames: event number (16 bit) and value (32 bit), then the address.
  const auto frames = receive_frames(events_);
  empty_ = !frames;
  if (!frames || frames->empty() || (*frames)[0].size() < 6) return std::nullopt;
  std::uint16_t number = 0;
  std::int32_t value = -1;
  std::memcpy(&number, (*frames)[0].data(), sizeof number);
  std::memcpy(&value, static_cast<const char*>((*frames)[0].data()) + sizeof number, sizeof value);
  using Kind = ConnectionEvent::Kind;
  const Kind kind = number == ZMQ_EVENT_HANDSHAKE_SUCCEEDED ? Kind::opened
                    : number == ZMQ_EVENT_DISCONNECTED      ? Kind::ended
                    : (number & handshake_broken) != 0      ? Kind::broken
                                                            : Kind::refused;
  return ConnectionEvent{kind, value};
}

std::shared_ptr<zmq::context_t> context_for(const Endpoint& endpoint) {
  if (!endpoint.inproc) return std::make_shared<zmq::context_t>(1);
  static std::mutex mutex;
  static std::weak_ptr<zmq::context_t> common;
  const std::lock_guard guard(mutex);
  auto context = common.lock();
  if (!context) common = context = std::make_shared<zmq::context_t>(1);
  return context;
}

bool is_farewell(const std::vector<zmq::message_t>& frames) {
  return frames.size() == 1 && frames[0].size() == 0;
}

void send_farewell(zmq::socket_t& socket, const std::string& address) {
  zmq::message_t to(address.data(), address.size()), farewell;
  if (!address.empty() && !send_frame(to, socket, ZMQ_SNDMORE | ZMQ_DONTWAIT)) return;
  send_frame(farewell, socket, ZMQ_DONTWAIT);
}

bool send_frame(zmq::message_t& frame, zmq::socket_t& socket, int flags) {
  while (zmq_msg_send(frame.handle(), socket.handle(), flags) < 0)
    if (zmq_errno() != EINTR) return false;
  return true;
}

std::optional<std::vector<zmq::message_t>> receive_frames(zmq::socket_t& socket) {
  std::vector<zmq::message_t> frames;
  frames.reserve(usual_frames);
  do {
    // The other frames of a message are always there with the first.
    const int waiting = frames.empty() ? ZMQ_DONTWAIT : 0;
    frames.emplace_back();
    while (zmq_msg_recv(frames.back().handle(), socket.handle(), waiting) < 0)
      if (zmq_errno() != EINTR) return std::nullopt;
  } while (frames.back().more());
  return frames;
}

void wait_for_input(zmq::socket_t& one, zmq::socket_t& other, long milliseconds) {
  if (!may_be_read(one) && !may_be_read(other)) second_is_told_of(one, other, milliseconds);
}

}  // namespace standoff
