#include "coupling/broker/broker.hpp"

#include <chrono>
#include <cstdio>
#include <deque>
#include <optional>

#include "coupling/broker/checkpoint_store.hpp"
#include "coupling/broker/event_lines.hpp"
#include "coupling/contract/process_watch.hpp"
#include "coupling/transport/codec.hpp"
#include "coupling/transport/router.hpp"

namespace standoff {
namespace {

using namespace std::chrono_literals;
constexpr auto tick = 50ms;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class BrokerLoop {
 public:
  explicit BrokerLoop(const BrokerOptions& options)
      : options_(options),
        endpoint_(parse_endpoint(options.listen, options.insecure)),
        lock_(endpoint_),
        router_(endpoint_),
        state_(open_session(options.rules, now())) {
    if (const std::string& folder = options.rules.checkpoint.folder; !folder.empty())
      checkpoints_.emplace(folder, options.build);
    options_.print(listening_line(router_.endpoint()));
  }

  int run() {
    while (!code_) {
      router_.wait(tick);
      // In this order, so that the last words of a peer that is gone are heard before its end is believed.
      const std::vector<std::string> gone = router_.take_gone();
      while (auto arrival = router_.receive()) handle(read(std::move(*arrival)));
      for (const std::string& address : gone) handle(Disconnected{address});
      if (const double time = now(); time - ticked_ >= std::chrono::duration<double>(tick).count()) {
        ticked_ = time;
        handle(Tick{});
        if (const std::string reason = reason_to_end(); !reason.empty()) handle(Interrupted{reason});
      }
    }
    if (state_.failure) std::fprintf(stderr, "standoff-broker: error: %s\n", first_cause(*state_.failure).c_str());
    return static_cast<int>(*code_);
  }

 private:
  SessionEvent read(Router::Arrival arrival) {
    try {
      Parcel parcel = decode(std::move(arrival.frames));
      Received received{arrival.address, std::move(parcel.envelope), std::move(parcel.body), {}, parcel.payload, 0};
      if (parcel.payload) {
        received.fields = parcel.payload->shapes();
        received.bytes = parcel.payload->bytes();
      }
      return received;
    } catch (const ProtocolError& error) {
      return Malformed{arrival.address, error.what()};
    }
  }

  void handle(SessionEvent event) {
    std::deque<SessionEvent> due;  // an action may bring about another event
    due.push_back(std::move(event));
    for (; !due.empty(); due.pop_front()) {
      SessionStep step = step_session(std::move(state_), due.front(), now());
      state_ = std::move(step.state);
      for (SessionAction& action : step.actions)
        if (auto consequence = carry_out(action)) due.push_back(std::move(*consequence));
    }
  }

  std::optional<SessionEvent> carry_out(SessionAction& action) {
    if (auto* send = std::get_if<Send>(&action)) return deliver(*send);
    if (auto* announce = std::get_if<Announce>(&action)) return print(announce->what);
    if (auto* half = std::get_if<Commit>(&action)) return commit(half->state);
    if (!code_) code_ = std::get<Finish>(action).code;
    return std::nullopt;
  }

  std::optional<SessionEvent> deliver(const Send& send) {
    switch (router_.send(send.address, encode(send.envelope, send.body, send.payload.get()))) {
      case Router::Delivery::sent:
        return std::nullopt;
      case Router::Delivery::gone:
        return Disconnected{send.address};
      case Router::Delivery::full:
        break;
    }
    return Malformed{send.address, "it does not read its messages"};
  }

  SessionEvent commit(const InterfaceState& state) {
    try {
      checkpoints_->commit(state);
      return Committed{};
    } catch (const Stop& stop) {
      return Committed{stop.what()};
    }
  }

  std::optional<SessionEvent> print(const Announcement& what) {
    try {
      options_.print(event_line(what));
      return std::nullopt;
    } catch (const Stop& stop) {
      const auto& report = std::get<announce::Report>(what);
      for (const Peer& peer : state_.peers)
        if (peer.name == report.name) return Malformed{peer.address, stop.what()};
      throw;
    }
  }

  const BrokerOptions& options_;
  const Endpoint endpoint_;
  const EndpointLock lock_;
  Router router_;
  SessionState state_;
  std::optional<CheckpointStore> checkpoints_;
  double ticked_ = 0.0;
  std::optional<ExitCode> code_;
};

}  // namespace

int run_broker(const BrokerOptions& options) {
  return BrokerLoop(options).run();
}

}  // namespace standoff
