#include "coupling/transport/dealer.hpp"

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/transport/curve.hpp"
#include "coupling/transport/endpoint.hpp"
#include "coupling/transport/socket_watch.hpp"

namespace standoff {
namespace {

constexpr int most_queued = 256;
constexpr int linger_ms = 1000;
constexpr int retry_ms = 50;  // between attempts to connect while the broker is not there yet
// A broker that ends while it greets us breaks one greeting and is gone at the next attempt; one whose key is another
// than we think breaks them all.
constexpr int greetings_broken_by_keys = 3;

}  // namespace

struct Dealer::Impl {
  explicit Impl(const Endpoint& given) : endpoint(given), connected(given.inproc) {}
  Endpoint endpoint;
  std::shared_ptr<zmq::context_t> context = context_for(endpoint);
  zmq::socket_t socket{*context, zmq::socket_type::dealer};
  SocketWatch watch{*context, socket};
  bool connected, lost = false, refused = false;
  bool empty = false;  // the last that was done is a look for a message, and there was none
  int broken_greetings = 0;
};

Dealer::Dealer(const std::string& endpoint, const CurveKeys& keys, bool insecure)
    : impl_(std::make_unique<Impl>(parse_endpoint(endpoint, insecure || keys.on()))) {
  zmq::socket_t& socket = impl_->socket;
  socket.set(zmq::sockopt::linger, linger_ms);
  // ZMQ_IMMEDIATE stays off: with it, libzmq 4.3.4 drops what has arrived and was not yet read when a connection ends,
  // and with that the last words of the broker. Nothing is sent before `connected` anyway.
  socket.set(zmq::sockopt::sndhwm, most_queued);
  socket.set(zmq::sockopt::rcvhwm, most_queued);
  socket.set(zmq::sockopt::maxmsgsize, most_frame_bytes);
  socket.set(zmq::sockopt::reconnect_ivl, retry_ms);
  if (keys.on()) use_as_client(socket, keys);
  try {
    socket.connect(endpoint);
  } catch (const zmq::error_t& error) {
    throw Stop(ExitCode::bad_case, fmt::format("cannot connect to {}: {}", endpoint, error.what()));
  }
}

Dealer::~Dealer() {
  if (impl_->endpoint.inproc && !impl_->lost) send_farewell(impl_->socket);
  if (impl_->lost) impl_->socket.set(zmq::sockopt::linger, 0);  // nobody is there to take what is still queued
}

void Dealer::wait(std::chrono::milliseconds timeout) {
  impl_->watch.wait(timeout.count(), impl_->empty);
}

void Dealer::look() {
  while (const auto event = impl_->watch.next()) {
    if (event->kind == ConnectionEvent::Kind::refused)
      impl_->refused = true;
    else if (event->kind == ConnectionEvent::Kind::broken)
      impl_->refused = impl_->refused || ++impl_->broken_greetings >= greetings_broken_by_keys;
    else if (event->kind == ConnectionEvent::Kind::opened)
      impl_->connected = true;
    else if (impl_->connected)
      impl_->lost = true;
  }
}

bool Dealer::connected() const {
  return impl_->connected;
}

bool Dealer::lost() const {
  return impl_->lost;
}

bool Dealer::refused() const {
  return impl_->refused && !impl_->connected;
}

std::optional<Frames> Dealer::receive() {
  auto frames = receive_frames(impl_->socket);
  impl_->empty = !frames;
  if (!frames || !impl_->endpoint.inproc || !is_farewell(*frames)) return frames;
  impl_->lost = true;
  return std::nullopt;
}

bool Dealer::send(Frames frames, std::chrono::milliseconds timeout) {
  using std::chrono::steady_clock;
  impl_->empty = false;
  const auto hand_over = [&](std::size_t i) {
    const int more = i + 1 < frames.size() ? ZMQ_SNDMORE : 0;
    return send_frame(frames[i], impl_->socket, more | ZMQ_DONTWAIT);
  };
  for (const auto until = steady_clock::now() + timeout; !hand_over(0);) {
    if (zmq_errno() != EAGAIN) return false;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - steady_clock::now());
    zmq_pollitem_t room = {impl_->socket.handle(), 0, ZMQ_POLLOUT, 0};
    if (left.count() <= 0 || zmq_poll(&room, 1, left.count()) == 0) return false;
  }
  for (std::size_t i = 1; i < frames.size(); ++i)
    if (!hand_over(i)) return false;
  return true;
}

}  // namespace standoff
