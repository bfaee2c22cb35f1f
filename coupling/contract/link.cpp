#include "coupling/contract/link.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "coupling/contract/process_watch.hpp"

namespace standoff {
namespace {

using namespace std::chrono_literals;
constexpr auto slice = 100ms;   // how long anything may go unnoticed
constexpr auto own_pause = 1s;  // a process that was itself stopped for longer blames nobody for that time
constexpr auto send_timeout = 2s;
constexpr auto verdict_timeout = 500ms;
constexpr auto show_interval = 100ms;

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace

Link::Link(const ParticipantOptions& options)
    : options_(options), dealer_(options.endpoint, options.keys, options.insecure) {
  last_sent_ = last_heard_ = last_look_ = Clock::now();
  join();
  keeper_ = std::thread([this] { keep(); });
}

Link::~Link() {
  {
    const std::lock_guard guard(keeper_mutex_);
    keeper_ends_ = true;
  }
  keeper_wakes_.notify_all();
  if (keeper_.joinable()) keeper_.join();
}

void Link::join() {
  const std::lock_guard guard(mutex_);
  const auto until = Clock::now() + std::chrono::duration<double>(options_.join_deadline);
  auto wait_on = [&](const char* what) {
    dealer_.wait(slice);
    last_heard_ = Clock::now();  // nobody owes us a sign of life yet
    pump();
    throw_if_failed();
    if (Clock::now() > until)
      throw Stop(ExitCode::participant_lost, fmt::format("{} at {} within {:g} s: is standoff-broker running there?",
                                                         what, options_.endpoint, options_.join_deadline));
  };
  while (!dealer_.connected()) {
    wait_on("no broker answered");
    if (dealer_.refused())
      throw Stop(ExitCode::bad_case,
                 fmt::format("the broker at {} does not accept our keys: --curve-server must be its "
                             "public key and --curve-allow of the broker must hold ours, or neither "
                             "side has keys",
                             options_.endpoint));
  }
  post(message::Hello{options_.name, options_.role, options_.version, options_.case_hash, getpid(), host_name(),
                      options_.keeps});
  while (!welcome_) wait_on("the broker did not take up HELLO");
}

void Link::send(const Message& body, const Payload* payload) {
  const std::lock_guard guard(mutex_);
  throw_if_failed();
  post(body, payload);
  throw_if_failed();
}

Parcel Link::await(std::initializer_list<std::size_t> kinds) {
  const std::lock_guard guard(mutex_);
  for (;;) {
    throw_if_failed();
    if (!inbox_.empty()) break;
    dealer_.wait(slice);
    pump();
  }
  Parcel parcel = std::move(inbox_.front());
  inbox_.pop_front();
  if (std::find(kinds.begin(), kinds.end(), parcel.body.index()) == kinds.end()) {
    note_failure(
        {"broker", ExitCode::participant_lost,
         fmt::format("broke the protocol: {} when {} was due", message_name(parcel.body), message_name(*kinds.begin())),
         window_},
        true);
    throw_if_failed();
  }
  return parcel;
}

void Link::show(const NamedValues& values) {
  const std::lock_guard guard(mutex_);
  throw_if_failed();
  held_back_ = values;
  if (Clock::now() - shown_at_ >= show_interval) {
    shown_at_ = Clock::now();
    post(message::Progress{std::move(*held_back_)});
    held_back_.reset();
  }
}

void Link::flush_progress() {
  const std::lock_guard guard(mutex_);
  if (held_back_ && !failure_) post(message::Progress{std::move(*held_back_)});
  held_back_.reset();
}

void Link::moved() {
  progress_.fetch_add(1, std::memory_order_relaxed);
  if (!failed_) return;
  const std::lock_guard guard(mutex_);
  throw_if_failed();
}

void Link::fail(message::Abort failure) noexcept {
  try {
    const std::lock_guard guard(mutex_);
    dealer_.look();
    while (auto frames = dealer_.receive()) take(std::move(*frames));  // an earlier cause may be on its way
    if (!failure_ && !closed_) {
      note_failure(std::move(failure), true);
      hear_verdict();
    }
    told_ = true;
  } catch (...) {
    // Nothing more can be done: the broker sees the connection end.
  }
}

std::optional<message::Abort> Link::failure() {
  const std::lock_guard guard(mutex_);
  return failure_;
}

void Link::hear_verdict() {
  const auto until = Clock::now() + verdict_timeout;
  while (welcome_ && !dealer_.lost() && Clock::now() < until) {
    dealer_.wait(slice);
    dealer_.look();
    while (auto frames = dealer_.receive()) {
      const Parcel parcel = decode(std::move(*frames));
      if (const auto* abort = std::get_if<message::Abort>(&parcel.body)) return void(failure_ = *abort);
    }
  }
}

void Link::close() {
  const std::lock_guard guard(mutex_);
  closed_ = true;
}

void Link::keep() {
  std::unique_lock keeper(keeper_mutex_);
  while (!keeper_wakes_.wait_for(keeper, slice, [&] { return keeper_ends_; })) {
    const std::unique_lock guard(mutex_, std::try_to_lock);
    if (!guard || closed_) continue;  // the solver is in a call and looks for itself
    pump();
    if (!failure_ || told_ || seconds(Clock::now() - failed_at_) < options_.leave_within) continue;
    const std::string text = first_cause(*failure_);
    told_ = true;
    if (options_.end_process) {
      options_.end_process(failure_->code, text);
    } else {
      std::fprintf(stderr, "standoff-%s: error: %s\n", options_.name.c_str(), text.c_str());
      _exit(static_cast<int>(failure_->code));
    }
  }
}

void Link::pump() {
  if (failure_ || closed_) return;
  dealer_.look();
  const bool lost = dealer_.lost();  // believed only when everything that came before it has been read
  while (auto frames = dealer_.receive()) take(std::move(*frames));
  const auto now = Clock::now();
  check_signals();
  if (lost && !(inbox_.size() == 1 && std::holds_alternative<message::ByeAck>(inbox_.front().body)))
    note_failure({"broker", ExitCode::participant_lost, "the process ended without a goodbye", -1}, false);
  check_silence(now);
  if (failure_ || !welcome_) return;
  if (held_back_ && now - shown_at_ >= show_interval) {
    shown_at_ = now;
    post(message::Progress{std::move(*held_back_)});
    held_back_.reset();
  }
  if (seconds(now - last_sent_) >= beat_interval_) post(message::Beat{progress_});
}

void Link::check_signals() {
  if (is_saving()) return;
  const std::string reason = reason_to_end();
  if (reason.empty()) return;
  if (between_windows_ && options_.keeps) set_saving();  // without effect unless it was a signal
  if (is_saving())
    post(message::StopWindows{0, reason, true});
  else
    note_failure({options_.name, ExitCode::interrupted, reason, window_}, true);
}

void Link::check_silence(Clock::time_point now) {
  if (now - last_look_ > own_pause) last_heard_ = std::min(now, last_heard_ + (now - last_look_));
  last_look_ = now;
  if (seconds(now - last_heard_) > beat_deadline_)
    note_failure(
        {"broker", ExitCode::participant_lost,
         fmt::format("no sign of life for {:g} s: the process is frozen or its host is cut off", beat_deadline_), -1},
        true);
}

void Link::take(Frames frames) {
  if (failure_) return;
  last_heard_ = Clock::now();
  try {
    Parcel parcel = decode(std::move(frames));
    if (const auto* reject = std::get_if<message::Reject>(&parcel.body))
      return note_failure({"broker", reject->code,
                           fmt::format("rejected \"{}\": {}; {}", options_.name, reject->reason, reject->remedy), -1},
                          false);
    if (const auto* abort = std::get_if<message::Abort>(&parcel.body)) return note_failure(*abort, false);
    if (parcel.envelope.token != options_.token) throw ProtocolError("another run token than ours");
    if (parcel.envelope.sequence != received_ + 1)
      throw ProtocolError(fmt::format("{} has sequence number {}, expected {}", message_name(parcel.body),
                                      parcel.envelope.sequence, received_ + 1));
    received_ = parcel.envelope.sequence;
    if (const auto* welcome = std::get_if<message::Welcome>(&parcel.body)) {
      welcome_ = true;
      epoch_ = welcome->epoch;
      beat_interval_ = welcome->beat_interval;
      beat_deadline_ = welcome->beat_deadline;
    } else if (!std::holds_alternative<message::Beat>(parcel.body)) {
      if (parcel.payload) bytes_ += parcel.payload->bytes();
      inbox_.push_back(std::move(parcel));
    }
  } catch (const ProtocolError& error) {
    note_failure({"broker", ExitCode::participant_lost, fmt::format("broke the protocol: {}", error.what()), window_},
                 true);
  }
}

void Link::post(const Message& body, const Payload* payload) {
  const Envelope envelope{options_.token, epoch_, ++sent_, options_.name, window_};
  if (payload != nullptr) bytes_ += payload->bytes();
  if (!dealer_.send(encode(envelope, body, payload), send_timeout)) {
    dealer_.look();
    while (auto frames = dealer_.receive()) take(std::move(*frames));
    note_failure({"broker", ExitCode::participant_lost,
                  dealer_.lost() ? "the process ended without a goodbye" : "it does not take our messages", -1},
                 false);
  }
  last_sent_ = Clock::now();
}

void Link::note_failure(message::Abort failure, bool tell) {
  if (failure_ || closed_) return;
  failure_ = std::move(failure);
  failed_at_ = Clock::now();
  failed_ = true;
  if (!tell) return;
  const Envelope envelope{options_.token, epoch_, ++sent_, options_.name, window_};
  dealer_.send(encode(envelope, *failure_, nullptr), 0ms);
}

void Link::throw_if_failed() {
  if (!failure_) return;
  told_ = true;
  throw Stop(failure_->code, first_cause(*failure_));
}

}  // namespace standoff
