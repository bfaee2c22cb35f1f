#pragma once
// A participant's end of the connection: what a Participant is made of. The solver's thread sends and receives itself,
// so an exchange costs no change of thread; while it computes, a keeper thread looks after the socket under the same
// lock: it beats, hears ABORT, notices a dead broker, a signal and a dead parent.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "coupling/contract/participant.hpp"
#include "coupling/session/messages.hpp"
#include "coupling/transport/dealer.hpp"

namespace standoff {

class Link {
 public:
  explicit Link(const ParticipantOptions& options);  // HELLO, WELCOME; throws Stop
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Throws Stop with the first cause if the run has failed.
  void send(const Message& body, const Payload* payload = nullptr);
  /// The next message that is not a heartbeat. Throws Stop likewise; throws it too for a message of another kind than
  /// the wanted ones (indices in Message).
  Parcel await(std::initializer_list<std::size_t> kinds);
  /// A progress line: at once, or held back so that there are at most ten a second.
  void show(const NamedValues& values);
  void flush_progress();

  /// The solver has moved. Throws Stop if the run has failed.
  void moved();
  void set_window(std::int64_t window) { window_ = window; }
  /// From START to the last window: a signal then asks the broker to save first, if this side can.
  void set_between_windows(bool yes) { between_windows_ = yes; }
  /// The first failure, told to everyone; later ones are consequences and are dropped.
  void fail(message::Abort failure) noexcept;
  std::optional<message::Abort> failure();
  /// BYE_ACK is in: silence is no longer a failure.
  void close();
  std::int64_t bytes() const { return bytes_; }

 private:
  using Clock = std::chrono::steady_clock;

  void join();
  void keep();
  // With the lock held:
  void pump();
  void take(Frames frames);
  void post(const Message& body, const Payload* payload = nullptr);
  void check_silence(Clock::time_point now);
  void check_signals();
  /// The broker answers our ABORT with the first failure: ours, or one that was faster.
  void hear_verdict();
  void note_failure(message::Abort failure, bool tell);
  void throw_if_failed();

  const ParticipantOptions& options_;
  std::mutex mutex_;
  Dealer dealer_;
  std::deque<Parcel> inbox_;
  std::optional<message::Abort> failure_;
  std::atomic<bool> failed_{false};
  bool told_ = false, closed_ = false, welcome_ = false;
  std::atomic<bool> between_windows_{false};
  std::uint32_t epoch_ = 0;
  std::uint64_t sent_ = 0, received_ = 0;
  std::atomic<std::uint64_t> progress_{0};
  std::atomic<std::int64_t> window_{-1};
  std::atomic<std::int64_t> bytes_{0};
  double beat_interval_ = 1.0, beat_deadline_ = 5.0;  // s, replaced by WELCOME
  Clock::time_point last_sent_, last_heard_, last_look_, failed_at_, shown_at_;
  std::optional<NamedValues> held_back_;

  std::mutex keeper_mutex_;
  std::condition_variable keeper_wakes_;
  bool keeper_ends_ = false;
  std::thread keeper_;
};

}  // namespace standoff
