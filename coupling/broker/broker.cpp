#include "coupling/broker/broker.hpp"

#include <chrono>
#include <cstdio>
#include <deque>
#include <future>
#include <optional>
#include <set>

#include "coupling/broker/checkpoint_store.hpp"
#include "coupling/broker/event_lines.hpp"
#include "coupling/contract/process_watch.hpp"
#include "coupling/contract/surface_fields.hpp"
#include "coupling/tape/tape_writer.hpp"
#include "coupling/transport/codec.hpp"
#include "coupling/transport/router.hpp"

namespace standoff {
namespace {

using namespace std::chrono_literals;
constexpr auto tick = 50ms;
constexpr double longest_farewell = 1.0;  // s; one that is frozen does not hold up the others' end

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

TapeHead tape_head(const SessionState& state) {
  TapeHead head;
  head.case_hash = state.case_hash;
  head.clock = state.clock;
  for (const Peer& peer : state.peers) (peer.role == Role::load ? head.load_needs : head.structure_needs) = peer.needs;
  head.surface = mesh_from(*state.surface_payload, state.surface.nodes, state.surface.quads);
  return head;
}

class BrokerLoop {
 public:
  explicit BrokerLoop(const BrokerOptions& options)
      : options_(options),
        endpoint_(parse_endpoint(options.listen, options.insecure || options.keys.on())),
        lock_(endpoint_),
        router_(endpoint_, options.keys),
        state_(open_session(options.rules, now())) {
    if (const std::string& folder = options.rules.checkpoint.folder; !folder.empty())
      checkpoints_.emplace(folder, options.build);
    if (!options.tape.empty()) tape_.emplace(options.tape);
    options_.print(listening_line(router_.endpoint()));
  }

  int run() {
    while (!code_) {
      router_.wait(tick);
      // In this order, so that the last words of a peer that is gone are heard before its end is believed.
      lost_ = router_.take_gone();
      lost_.insert(lost_.end(), unreachable_.begin(), unreachable_.end());
      unreachable_.clear();
      while (auto arrival = router_.receive()) handle(read(std::move(*arrival)));
      for (const std::string& address : lost_) handle(Disconnected{address});
      if (auto written = written_within(0ms)) handle(*written);
      if (const double time = now(); time - ticked_ >= std::chrono::duration<double>(tick).count()) {
        ticked_ = time;
        handle(Tick{});
        if (const std::string reason = reason_to_end(); !reason.empty()) handle(Interrupted{reason});
      }
    }
    see_off();
    if (state_.failure) std::fprintf(stderr, "standoff-broker: error: %s\n", first_cause(*state_.failure).c_str());
    return static_cast<int>(*code_);
  }

 private:
  /// After a failure the others may still be writing: once they have gone, what is unfinished is removed.
  void see_off() {
    if (disk_.valid()) disk_.wait();
    if (!state_.failure || !checkpoints_) return;
    std::set<std::string> here;
    for (const Peer& peer : state_.peers)
      if (peer.stage != Stage::closed) here.insert(peer.address);
    for (const double end = now() + longest_farewell; !here.empty() && now() < end;) {
      for (const std::string& address : lost_) here.erase(address);
      lost_ = router_.take_gone();
      while (router_.receive()) continue;
      if (lost_.empty()) router_.wait(tick);
    }
    checkpoints_->sweep();
  }

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
      if (tape_ && !state_.over)
        if (auto consequence = record(due.front())) due.push_back(std::move(*consequence));
    }
  }

  std::optional<SessionEvent> carry_out(SessionAction& action) {
    if (auto* send = std::get_if<Send>(&action)) return deliver(*send);
    if (auto* announce = std::get_if<Announce>(&action)) return print(announce->what);
    if (auto* half = std::get_if<Commit>(&action)) {
      disk_ = std::async(std::launch::async, [this, state = std::move(half->state)] { return commit(state); });
      return written_within(tick);
    }
    if (!code_) code_ = std::get<Finish>(action).code;
    return std::nullopt;
  }

  std::optional<SessionEvent> deliver(const Send& send) {
    switch (router_.send(send.address, encode(send.envelope, send.body, send.payload.get()))) {
      case Router::Delivery::sent:
        return std::nullopt;
      case Router::Delivery::gone:
        unreachable_.push_back(send.address);  // its last words may not have been read yet
        return std::nullopt;
      case Router::Delivery::full:
        break;
    }
    return Malformed{send.address, "it does not read its messages"};
  }

  /// What has just been taken in, for the tape: its head when the clock is set, then every ADVANCE.
  std::optional<SessionEvent> record(const SessionEvent& event) {
    const auto* received = std::get_if<Received>(&event);
    if (received == nullptr || state_.clock.windows == 0) return std::nullopt;
    try {
      if (!tape_begun_) tape_->head(tape_head(state_));
      if (!tape_begun_) tape_begun_ = now();
      if (const auto* advance = std::get_if<message::Advance>(&received->body))
        for (const Peer& peer : state_.peers)
          if (peer.address == received->address)
            tape_->frame(peer.role, advance->window, advance->totals, now() - *tape_begun_, received->payload);
      return std::nullopt;
    } catch (const Stop& stop) {
      return DiskFailed{stop.what()};
    }
  }

  /// On a thread of its own: a disk may take longer than the silence that the others allow.
  SessionEvent commit(const InterfaceState& state) const {
    try {
      checkpoints_->commit(state);
      return Committed{};
    } catch (const Stop& stop) {
      return DiskFailed{stop.what()};
    }
  }

  /// How the checkpoint that is being written has ended, if it has.
  std::optional<SessionEvent> written_within(std::chrono::milliseconds time) {
    if (!disk_.valid() || disk_.wait_for(time) != std::future_status::ready) return std::nullopt;
    return disk_.get();
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
  std::optional<TapeWriter> tape_;
  std::optional<double> tape_begun_;
  std::vector<std::string> lost_, unreachable_;  // addresses that have just gone
  double ticked_ = 0.0;
  std::optional<ExitCode> code_;
  std::future<SessionEvent> disk_;  // last, so that what it uses outlives it
};

}  // namespace

int run_broker(const BrokerOptions& options) {
  return BrokerLoop(options).run();
}

}  // namespace standoff
