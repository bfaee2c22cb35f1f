#pragma once
// The other end of a participant's connection, scripted: a broker that says what a rule tells it to say, right or
// wrong, and remembers what it hears. It starts the participant as a process of its own and knows how that ended.
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/private_folder.hpp"
#include "coupling/transport/router.hpp"

namespace standoff::conform {

/// The participant does not do what the rule asks; the text says what it did instead.
class RuleBroken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ProcessEnd {
  bool by_signal = false;
  int number = 0;  // exit status or signal
};

class Counterpart {
 public:
  /// Starts `command` with --case --connect --token --threads behind its own words.
  Counterpart(const std::vector<std::string>& command, const std::string& case_file);
  ~Counterpart();
  Counterpart(const Counterpart&) = delete;
  Counterpart& operator=(const Counterpart&) = delete;

  /// `spoil` may change the frames on their way out.
  using Spoil = std::function<void(Frames&)>;
  void say(const Message& body, const Payload* payload = nullptr, const Spoil& spoil = nullptr);
  void skip_sequence_numbers(std::uint64_t count) { sent_ += count; }
  void set_window(std::int64_t window) { window_ = window; }
  /// The next message that is not BEAT, PROGRESS or SAMPLE; nothing if none comes within `seconds`.
  std::optional<Parcel> hear(double seconds);
  /// The same, of kind Body; throws RuleBroken for another one, for the end of the process and for silence.
  template <class Body>
  Parcel expect(double seconds = 20.0) {
    return expect_kind(Message(Body{}).index(), seconds);
  }
  /// Listens for `seconds`; throws RuleBroken if anything but BEAT, PROGRESS or SAMPLE comes.
  void expect_quiet(double seconds);
  /// Waits for the end of the process, hearing on.
  ProcessEnd wait_end(double seconds);
  /// Tells a side that the run is over: signalled between windows, it would wait for the broker to save first.
  void call_off();

  void stop_beating() { beating_ = false; }
  void hang_up() { router_.reset(); }
  void signal(int number) const { child_.signal(number); }
  void set_beat_interval(double seconds) { beat_interval_ = seconds; }

  struct BeatHeard {
    double at = 0.0;  // s since the start
    std::uint64_t progress = 0;
  };
  const std::vector<BeatHeard>& beats() const { return beats_; }
  double seconds() const;
  /// Last lines of what the participant printed on its error output.
  std::string said() const;
  const Envelope& first_envelope() const { return *first_; }
  /// Processes and files that are there although the participant has ended; empty if nothing was left.
  std::string leftovers() const;

 private:
  Parcel expect_kind(std::size_t kind, double seconds);
  void pump();
  void take(Frames frames);
  bool reap();

  launch::PrivateFolder folder_;
  std::string endpoint_, token_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::unique_ptr<Router> router_;
  launch::ChildProcess child_;
  std::set<std::string> own_files_;
  std::optional<ProcessEnd> end_;
  std::string address_, broken_;  // address of the participant; what was wrong with an envelope
  std::vector<Parcel> inbox_;
  std::optional<Envelope> first_;
  std::vector<BeatHeard> beats_;
  std::uint64_t sent_ = 0, heard_ = 0;
  std::int64_t window_ = -1;
  double last_said_ = 0.0, beat_interval_ = 0.2;
  bool beating_ = false, lost_ = false;
};

}  // namespace standoff::conform
