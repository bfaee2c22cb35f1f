#pragma once
// Watches the processes of a run until all have ended: reads their outputs, waits for their ends, obeys signals and the
// time limit. The first thing that goes wrong is the outcome; everything after it is a consequence. Stopping: SIGTERM
// to every process group, SIGKILL after a grace time, never longer than 10 s in all. A run that is interrupted or out
// of time is asked through its broker first, which saves a checkpoint where it can: longer only while it says that it
// does.
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <signal.h>

#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/first_cause.hpp"

namespace standoff::launch {

/// Keeps SIGINT, SIGTERM, SIGHUP and SIGCHLD for a file descriptor instead of handlers; SIGPIPE and SIGXFSZ become
/// errors of write. Restores the mask at its end.
class SignalGate {
 public:
  SignalGate();
  ~SignalGate();
  SignalGate(const SignalGate&) = delete;
  SignalGate& operator=(const SignalGate&) = delete;
  int fd() const { return fd_; }
  /// Signals that arrived and ask us to stop.
  std::vector<int> take();

 private:
  int fd_ = -1;
  sigset_t before_{};
};

struct SupervisorTimes {
  double max_time = 0.0;         // s of wall clock; 0 = no limit
  double terminate = 3.0;        // s from SIGTERM to SIGKILL
  double ask = 3.0;              // s the broker has to say that it saves
  double save = 30.0;            // s it has to do so
  double settle = 0.5;           // s to learn how the process that the broker blames ended
  double end_after_done = 10.0;  // s the processes have to end after the broker's "done"
};

/// What the caller does with what it sees. Both may throw Stop: that is then the first cause.
struct SupervisorHooks {
  std::function<void(const ChildProcess& child, bool error_output, const std::string& line)> line;
  std::function<void()> tick;  // at least ten times a second
};

class Supervisor {
 public:
  Supervisor(const SupervisorTimes& times, SupervisorHooks hooks);
  ~Supervisor();  // nobody is left, whatever was thrown

  void start(const ChildCommand& command);
  /// To be called from the line hook.
  void broker_failed(const FailedEvent& event);
  void broker_done() { done_ = true; }
  void broker_saves() { saving_ = true; }

  /// Returns when all processes have ended: nothing if all is well, else the first cause.
  std::optional<Cause> watch();
  const std::vector<ChildProcess>& children() const { return children_; }
  double seconds() const;  // since construction

 private:
  void poll_once();
  void guarded(const std::function<void()>& hook);
  void read_outputs();
  void reap();
  void decide();
  std::optional<Cause> trouble();
  void stop_for(const Cause& cause);
  void ask_to_stop(const Cause& cause);
  bool asking_is_over() const;
  void signal_all(int number) const;
  bool anyone_alive() const;

  SupervisorTimes times_;
  SupervisorHooks hooks_;
  SignalGate signals_;
  std::vector<ChildProcess> children_;
  std::vector<ProcessEnd> ends_;
  std::optional<FailedEvent> failed_;
  std::optional<Cause> cause_;
  bool done_ = false, killed_ = false, asking_ = false, saving_ = false;
  std::chrono::steady_clock::time_point begin_;
  double suspicion_at_ = -1.0, stop_at_ = -1.0, done_at_ = -1.0;  // s since begin_
};

}  // namespace standoff::launch
