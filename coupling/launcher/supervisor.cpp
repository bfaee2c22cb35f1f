#include "coupling/launcher/supervisor.hpp"

#include <algorithm>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

namespace standoff::launch {
namespace {

constexpr std::size_t kept_lines = 8;

/// How `pid` ended, without releasing its number yet; nothing while it runs.
std::optional<ProcessEnd> ended(const ChildProcess& child) {
  siginfo_t info{};
  if (waitid(P_PID, static_cast<id_t>(child.pid), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == 0)
    return std::nullopt;
  return ProcessEnd{child.name, info.si_code != CLD_EXITED, info.si_status};
}

double seconds_of(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace

SignalGate::SignalGate() {
  sigset_t wanted;
  sigemptyset(&wanted);
  for (const int number : {SIGINT, SIGTERM, SIGCHLD}) sigaddset(&wanted, number);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaddset(&wanted, SIGHUP);  // nohup keeps its meaning
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  sigprocmask(SIG_BLOCK, &wanted, &before_);
  fd_ = signalfd(-1, &wanted, SFD_NONBLOCK | SFD_CLOEXEC);
}

SignalGate::~SignalGate() {
  take();
  if (fd_ >= 0) close(fd_);
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

std::vector<int> SignalGate::take() {
  std::vector<int> numbers;
  signalfd_siginfo info{};
  while (read(fd_, &info, sizeof info) == sizeof info)
    if (info.ssi_signo != SIGCHLD) numbers.push_back(static_cast<int>(info.ssi_signo));
  return numbers;
}

Supervisor::Supervisor(const SupervisorTimes& times, SupervisorHooks hooks)
    : times_(times), hooks_(std::move(hooks)), begin_(std::chrono::steady_clock::now()) {
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // what a participant leaves behind is handed to us, not to the system
}

Supervisor::~Supervisor() {
  for (ChildProcess& child : children_) {
    if (child.alive) {
      child.signal(SIGKILL);
      waitpid(child.pid, nullptr, 0);
    }
    child.out.close(), child.err.close();
  }
}

double Supervisor::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Supervisor::start(const ChildCommand& command) {
  children_.push_back(start_child(command));
}

void Supervisor::broker_failed(const FailedEvent& event) {
  if (!failed_) failed_ = event;
}

std::optional<Cause> Supervisor::watch() {
  while (anyone_alive()) poll_once();
  read_outputs();
  decide();
  return cause_;
}

void Supervisor::poll_once() {
  std::vector<pollfd> fds{{signals_.fd(), POLLIN, 0}};
  for (const ChildProcess& child : children_)
    for (const LineReader* reader : {&child.out, &child.err})
      if (reader->open()) fds.push_back({reader->fd(), POLLIN, 0});
  poll(fds.data(), fds.size(), 50);
  for (const int number : signals_.take()) {
    if (cause_)
      signal_all(SIGKILL), killed_ = true;  // asked twice: no grace
    else
      ask_to_stop({ExitCode::interrupted, "", "stopped by " + signal_text(number)});
  }
  reap();
  read_outputs();  // after the ends: what a process said before it ended is known before anyone judges
  decide();
  guarded(hooks_.tick);
}

void Supervisor::guarded(const std::function<void()>& hook) {
  try {
    hook();
  } catch (const Stop& stop) {
    stop_for({stop.code(), "", stop.what()});
  }
}

void Supervisor::read_outputs() {
  for (ChildProcess& child : children_) {
    child.out.read_some([&](const std::string& line) { guarded([&] { hooks_.line(child, false, line); }); });
    child.err.read_some([&](const std::string& line) {
      child.last_lines.push_back(line);
      if (child.last_lines.size() > kept_lines) child.last_lines.erase(child.last_lines.begin());
      guarded([&] { hooks_.line(child, true, line); });
    });
  }
}

void Supervisor::reap() {
  for (ChildProcess& child : children_) {
    if (!child.alive) continue;
    const auto end = ended(child);
    if (!end) continue;
    child.signal(SIGKILL);  // whatever it left in its group; its number is still ours until the next line
    rusage usage{};
    wait4(child.pid, nullptr, 0, &usage);
    while (waitpid(-child.pid, nullptr, 0) > 0) continue;  // its orphans have become ours
    child.alive = false;
    child.peak_bytes = usage.ru_maxrss * 1024;
    child.cpu_s = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    if (!cause_) ends_.push_back(*end);
  }
}

void Supervisor::decide() {
  const double now = seconds();
  if (asking_ && asking_is_over()) {
    const Cause cause = *std::exchange(cause_, std::nullopt);
    asking_ = false;
    stop_for(cause);
  }
  if (cause_) {
    if (!killed_ && !asking_ && now - stop_at_ > times_.terminate) signal_all(SIGKILL), killed_ = true;
    return;
  }
  if (done_ && done_at_ < 0.0) done_at_ = now;
  const bool in_time = times_.max_time <= 0.0 || now <= times_.max_time;
  if (const auto cause = trouble())
    stop_for(*cause);
  else if (!in_time)
    ask_to_stop({ExitCode::out_of_resources, "", fmt::format("out of time: --max-time {:g} s", times_.max_time)});
}

/// The first cause, once enough is known to name it.
std::optional<Cause> Supervisor::trouble() {
  const double now = seconds();
  if (const auto cause = first_cause(ends_, failed_)) {
    const bool by_signal = std::any_of(ends_.begin(), ends_.end(), [](const ProcessEnd& e) { return e.by_signal; });
    if (suspicion_at_ < 0.0) suspicion_at_ = now;
    if (by_signal || !anyone_alive() || now - suspicion_at_ > times_.settle) return cause;
    return std::nullopt;
  }
  if (!anyone_alive() && !done_)
    return Cause{ExitCode::participant_lost, "broker",
                 "all processes ended before the broker said that the run is done"};
  if (done_ && anyone_alive() && now - done_at_ > times_.end_after_done)
    for (const ChildProcess& child : children_)
      if (child.alive)
        return Cause{ExitCode::participant_lost, child.name,
                     fmt::format("did not end within {:g} s after the run was done", times_.end_after_done)};
  return std::nullopt;
}

/// The broker alone gets the signal: it tells the others when all is saved.
void Supervisor::ask_to_stop(const Cause& cause) {
  const auto broker = std::find_if(children_.begin(), children_.end(),
                                   [](const ChildProcess& c) { return c.name == "broker" && c.alive; });
  if (broker == children_.end()) return stop_for(cause);
  cause_ = cause;
  stop_at_ = seconds();
  asking_ = true;
  broker->signal(SIGTERM);
  signal_all(SIGCONT);
}

bool Supervisor::asking_is_over() const {
  const bool broker_alive = std::any_of(children_.begin(), children_.end(),
                                        [](const ChildProcess& c) { return c.name == "broker" && c.alive; });
  const double patience = !broker_alive ? times_.settle : saving_ ? times_.save : times_.ask;
  return seconds() - stop_at_ > patience;
}

void Supervisor::stop_for(const Cause& cause) {
  if (cause_) return;
  cause_ = cause;
  stop_at_ = seconds();
  signal_all(SIGTERM);
  signal_all(SIGCONT);  // a process that was frozen can act on it
}

void Supervisor::signal_all(int number) const {
  for (const ChildProcess& child : children_)
    if (child.alive) child.signal(number);
}

bool Supervisor::anyone_alive() const {
  return std::any_of(children_.begin(), children_.end(), [](const ChildProcess& c) { return c.alive; });
}

}  // namespace standoff::launch
