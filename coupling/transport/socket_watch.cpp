#include "coupling/transport/socket_watch.hpp"

#include <atomic>
#include <cstring>
#include <mutex>

#include <poll.h>

namespace standoff {
namespace {

constexpr int handshake_broken = ZMQ_EVENT_HANDSHAKE_FAILED_PROTOCOL | ZMQ_EVENT_HANDSHAKE_FAILED_NO_DETAIL;

constexpr std::size_t usual_frames = 4;  // address, envelope, two arrays

std::string fresh_name() {
  static std::atomic<unsigned> count{0};
  return "inproc://watch-" + std::to_string(count++);
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

std::optional<ConnectionEvent> SocketWatch::next() {
  // Two frames: event number (16 bit) and value (32 bit), then the address.
  const auto frames = receive_frames(events_);
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
  if (!address.empty() && zmq_send(socket.handle(), address.data(), address.size(), ZMQ_SNDMORE | ZMQ_DONTWAIT) < 0)
    return;
  zmq_send(socket.handle(), "", 0, ZMQ_DONTWAIT);
}

std::optional<std::vector<zmq::message_t>> receive_frames(zmq::socket_t& socket) {
  std::vector<zmq::message_t> frames;
  frames.reserve(usual_frames);
  frames.emplace_back();
  if (zmq_msg_recv(frames[0].handle(), socket.handle(), ZMQ_DONTWAIT) < 0) return std::nullopt;
  while (frames.back().more()) {
    frames.emplace_back();
    // The other frames of a message are always there with the first.
    while (zmq_msg_recv(frames.back().handle(), socket.handle(), 0) < 0)
      if (zmq_errno() != EINTR) return std::nullopt;
  }
  return frames;
}

void wait_for_input(zmq::socket_t& socket, zmq::socket_t& events, long milliseconds) {
  // A descriptor tells only of what came since its socket last looked, and sending looks, too.
  if ((socket.get(zmq::sockopt::events) & ZMQ_POLLIN) != 0) return;
  pollfd descriptors[] = {{socket.get(zmq::sockopt::fd), POLLIN, 0}, {events.get(zmq::sockopt::fd), POLLIN, 0}};
  poll(descriptors, 2, static_cast<int>(milliseconds));
}

}  // namespace standoff
