#include "coupling/transport/router.hpp"

#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/transport/curve.hpp"
#include "coupling/transport/socket_watch.hpp"

namespace standoff {
namespace {

constexpr int most_queued = 256;  // messages a peer may leave unread; the protocol has a handful under way
constexpr int linger_ms = 1000;   // so that the first cause still reaches those who listen, and no longer
constexpr int closed_descriptor = -1;

/// The descriptor a message came in on. Deprecated by libzmq in favour of the peer's address, which ipc peers share.
int descriptor_of(zmq::message_t& frame) {
  return zmq_msg_get(frame.handle(), ZMQ_SRCFD);
}

}  // namespace

struct Router::Impl {
  explicit Impl(const Endpoint& given) : endpoint(given) {}
  Endpoint endpoint;
  std::shared_ptr<zmq::context_t> context = context_for(endpoint);
  std::optional<KeyGate> gate;
  zmq::socket_t socket{*context, zmq::socket_type::router};
  SocketWatch watch{*context, socket};
  bool empty = false;                     // the last that was done is a look for a message, and there was none
  std::map<int, std::string> address_of;  // by descriptor
  std::set<std::string> here;             // inproc: who has said something
  std::vector<std::string> has_left;      // inproc: who has said farewell
};

Router::Router(const Endpoint& endpoint, const CurveKeys& keys) : impl_(std::make_unique<Impl>(endpoint)) {
  zmq::socket_t& socket = impl_->socket;
  socket.set(zmq::sockopt::linger, linger_ms);
  socket.set(zmq::sockopt::router_mandatory, true);
  socket.set(zmq::sockopt::sndhwm, most_queued);
  socket.set(zmq::sockopt::rcvhwm, most_queued);
  socket.set(zmq::sockopt::maxmsgsize, most_frame_bytes);
  if (keys.on()) {
    impl_->gate.emplace(*impl_->context, keys.allowed);
    use_as_server(socket, keys);
  }
  try {
    socket.bind(endpoint.text);
  } catch (const zmq::error_t& error) {
    throw Stop(ExitCode::bad_case, fmt::format("cannot listen on {}: {}", endpoint.text, error.what()));
  }
}

Router::~Router() {
  for (const std::string& address : impl_->here) send_farewell(impl_->socket, address);
}

std::string Router::endpoint() const {
  return impl_->socket.get(zmq::sockopt::last_endpoint);
}

void Router::wait(std::chrono::milliseconds timeout) {
  impl_->watch.wait(timeout.count(), impl_->empty);
}

std::optional<Router::Arrival> Router::receive() {
  auto frames = receive_frames(impl_->socket);
  impl_->empty = !frames;
  if (!frames) return std::nullopt;
  Arrival arrival;
  arrival.address = (*frames)[0].to_string();
  if (frames->size() > 1) {
    const int descriptor = descriptor_of((*frames)[1]);
    if (descriptor != closed_descriptor) impl_->address_of[descriptor] = arrival.address;
  }
  frames->erase(frames->begin());
  if (impl_->endpoint.inproc && is_farewell(*frames)) {
    impl_->here.erase(arrival.address);
    impl_->has_left.push_back(arrival.address);
    return receive();
  }
  if (impl_->endpoint.inproc) impl_->here.insert(arrival.address);
  arrival.frames = std::move(*frames);
  return arrival;
}

std::vector<std::string> Router::take_gone() {
  std::vector<std::string> gone = std::exchange(impl_->has_left, {});
  while (const auto event = impl_->watch.next()) {
    const auto known = impl_->address_of.find(event->descriptor);
    if (event->kind != ConnectionEvent::Kind::ended || known == impl_->address_of.end()) continue;
    gone.push_back(known->second);
    impl_->address_of.erase(known);
  }
  return gone;
}

Router::Delivery Router::send(const std::string& address, Frames frames) {
  impl_->empty = false;
  zmq::message_t to(address.data(), address.size());
  if (!send_frame(to, impl_->socket, ZMQ_SNDMORE | ZMQ_DONTWAIT))
    return zmq_errno() == EAGAIN ? Delivery::full : Delivery::gone;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const int more = i + 1 < frames.size() ? ZMQ_SNDMORE : 0;
    if (!send_frame(frames[i], impl_->socket, more | ZMQ_DONTWAIT)) return Delivery::gone;
  }
  return Delivery::sent;
}

}  // namespace standoff
