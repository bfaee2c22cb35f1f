#pragma once
// A participant without our participant library: says what a test tells it to say, right or wrong.
#include <functional>
#include <optional>
#include <stdexcept>

#include <unistd.h>

#include "coupling/transport/codec.hpp"
#include "coupling/transport/dealer.hpp"
#include "tests/contract/coupling_chaos_proxy.hpp"
#include "tests/contract/coupling_harness.hpp"

namespace standoff::test {

class RawPeer {
 public:
  explicit RawPeer(const ParticipantOptions& options) : options_(options), dealer_(options.endpoint, options.keys) {
    if (!eventually(10.0, [&] { return dealer_.look(), dealer_.connected(); })) throw std::runtime_error("no broker");
  }
  /// `change` may spoil the frames before they are sent.
  void say(const Message& body, const Payload* payload = nullptr,
           const std::function<void(Frames&)>& change = nullptr) {
    Frames frames = encode({options_.token, epoch_, ++sent_, options_.name, window_}, body, payload);
    if (change) change(frames);
    dealer_.send(std::move(frames), std::chrono::milliseconds(2000));
  }
  void hello() { say(message::Hello{options_.name, options_.role, "raw", options_.case_hash, getpid(), "here"}); }
  /// The next message that is not a heartbeat; throws after ten seconds without one.
  Parcel hear() {
    std::optional<Parcel> parcel;
    const bool heard = eventually(10.0, [&] {
      dealer_.wait(std::chrono::milliseconds(10));
      while (auto frames = dealer_.receive()) {
        parcel = decode(std::move(*frames));
        if (!std::holds_alternative<message::Beat>(parcel->body)) return true;
      }
      return false;
    });
    if (!heard) throw std::runtime_error("the broker is silent");
    if (const auto* welcome = std::get_if<message::Welcome>(&parcel->body)) epoch_ = welcome->epoch;
    window_ = parcel->envelope.window;
    return std::move(*parcel);
  }
  template <class Body>
  Body hear_a() {
    const Parcel parcel = hear();
    if (const Body* body = std::get_if<Body>(&parcel.body)) return *body;
    throw std::runtime_error(std::string("heard ") + message_name(parcel.body));
  }

 private:
  ParticipantOptions options_;
  Dealer dealer_;
  std::uint32_t epoch_ = 0;
  std::uint64_t sent_ = 0;
  std::int64_t window_ = -1;
};

}  // namespace standoff::test
