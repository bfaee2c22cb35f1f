#pragma once
// A run of forty windows that saves every fifth, and one fault in it: a line of faults.csv.
#include <fstream>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include "coupling/broker/checkpoint_store.hpp"
#include "tests/contract/coupling_chaos_proxy.hpp"
#include "tests/contract/coupling_harness.hpp"

namespace standoff::test {

struct Fault {
  std::string name, who, when, what, cause, own_code, own_cause;
  int code = 0;

  bool at_message() const { return when.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == 0; }
  bool at_rest() const { return when == "rest"; }
};

inline std::vector<Fault> read_faults() {
  std::vector<Fault> faults;
  std::ifstream file(STANDOFF_SOURCE_DIR "/tests/contract/faults.csv");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("#") || line.starts_with("fault|")) continue;
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, '|');) cells.push_back(cell);
    if (cells.size() != 8) throw std::runtime_error("faults.csv: not eight cells: " + line);
    faults.push_back({cells[0], cells[1], cells[2], cells[3], cells[5], cells[6], cells[7], std::stoi(cells[4])});
  }
  return faults;
}

/// Whether `text` holds the pieces of `pattern` between its stars, in their order.
inline bool holds(const std::string& text, const std::string& pattern) {
  std::istringstream pieces(pattern);
  std::size_t at = 0;
  for (std::string piece; std::getline(pieces, piece, '*'); at += piece.size())
    if ((at = text.find(piece, at)) == std::string::npos) return false;
  return true;
}

/// The next flush of this process, or of the next one forked from it, takes so long: a disk that stalls.
void stall_next_flush(double seconds);

/// The body of a participant returns as if its work were done.
struct Left {};

class FaultScene {
 public:
  explicit FaultScene(const Fault& fault) : fault_(fault) {
    BrokerOptions& broker = run_.broker;
    broker.rules.window = {WindowRule::Kind::fixed, 0.025};
    broker.rules.checkpoint = {run_.folder + "/checkpoint", 0.0, 5};
    broker.rules.deadlines.beat_interval = 0.1;
    if (fault.what == "freeze" || fault.what.starts_with("slow") || fault.what == "delay 4")
      broker.rules.deadlines.beat = 1.5;
    if (fault.what == "stuck") broker.rules.deadlines.progress = 0.5;
    if (fault.when.starts_with("HELLO")) broker.rules.deadlines.join = 1.0;
  }

  /// Starts everyone, the one with the fault last.
  void start() {
    if (fault_.who == "broker" && fault_.what == "slow disk") stall_next_flush(longer_than_silence);
    broker_.emplace(run_.start_broker());
    stall_next_flush(0.0);
    broker_pid_ = broker_->pid();
    const bool structure_first = fault_.who != "structure";
    const auto join = [&](bool structure) {
      (structure ? structure_ : load_).emplace(start_side(structure ? Role::structure : Role::load));
    };
    join(structure_first);
    eventually(10.0, [&] { return !run_.events("joined").empty(); });
    join(!structure_first);
  }

  CoupledRun& run() { return run_; }
  Child& process(const std::string& name) {
    return name == "broker" ? *broker_ : name == "particles" ? *load_ : *structure_;
  }
  /// Files that nobody may leave: sockets, locks, what was written in part.
  std::vector<std::string> leftovers() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(run_.folder)) {
      const std::string name = entry.path().filename();
      if (name == "broker" || name == "broker.lock" || name.ends_with(".part")) found.push_back(entry.path());
    }
    return found;
  }

 private:
  static constexpr double longer_than_silence = 2.5;  // s; 1.5 s are allowed

  ParticipantOptions options(Role role) {
    ParticipantOptions given = run_.options(role);
    given.keeps = true;
    given.leave_within = 0.5;
    if (given.name != fault_.who || !fault_.at_message()) return given;
    const std::string listen = "ipc://" + run_.folder + "/proxy";
    const auto space = fault_.when.find(' ');
    const Chaos chaos{fault_.when.substr(0, space), std::stol(fault_.when.substr(space + 1)), fault_.what};
    proxy_.emplace(run_.error_file("proxy"),
                   [listen, chaos, broker = given.endpoint] { return ChaosProxy(listen, broker, chaos).run(); });
    given.endpoint = listen;
    return given;
  }

  /// Called by each side at each point of its life; acts where the fault is. A fault of the broker is done to it by the
  /// load side, at rest by the structure.
  void reach(const std::string& name, const std::string& when) const {
    const std::string hand = fault_.who != "broker" ? fault_.who : fault_.at_rest() ? "structure" : "particles";
    if (hand != name || when != fault_.when) return;
    const pid_t victim = fault_.who == "broker" ? broker_pid_ : getpid();
    const auto sleep = [](double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); };
    if (fault_.what == "kill") kill(victim, SIGKILL);
    if (fault_.what == "freeze") kill(victim, SIGSTOP);
    if (fault_.what == "sigterm") kill(victim, SIGTERM);
    if (fault_.what == "sigint") kill(victim, SIGINT);
    if (fault_.what == "crash") signal(SIGSEGV, SIG_DFL), raise(SIGSEGV);
    if (fault_.what == "stuck") sleep(60.0);
    if (fault_.what == "slow") sleep(longer_than_silence);
    if (fault_.what == "slow disk" && fault_.who != "broker") stall_next_flush(longer_than_silence);
    if (fault_.what == "guard") throw Stop(ExitCode::guard, "energy has grown by 12 %: use a smaller step");
    if (fault_.what == "memory") throw std::bad_alloc();
    if (fault_.what == "exit") _exit(0);
    if (fault_.what == "leave") throw Left{};
    if (fault_.what == "disk") {
      const rlimit limit{1 << 14, 1 << 14};  // a state does not fit
      prlimit(victim, RLIMIT_FSIZE, &limit, nullptr);
    }
  }

  /// 100 kB of state; reach("checkpoint") when it is saved for the second time.
  KeptState kept(const std::string& name) const {
    return {[this, name, saves = 0]() mutable {
              if (++saves == 2) reach(name, "checkpoint");
              return std::string(100'000, 's');
            },
            [](std::span<const char>) {}};
  }

  Child start_side(Role role) {
    return run_.start(options(role), [this, role](Participant& link) {
      try {
        role == Role::load ? play_load(link) : play_structure(link);
      } catch (const Left&) {
        // its body is over
      }
    });
  }

  void play_load(Participant& link) const {
    reach("particles", "join");
    const SurfaceMesh mesh = link.receive_surface();
    reach("particles", "surface");
    link.keep(kept("particles"));
    link.ready({0.001, 0.0});
    while (const auto grant = link.next()) {
      reach("particles", "window " + std::to_string(grant->window));
      // A signal is looked for every 0.1 s; the run must not be over by then.
      if (fault_.what.starts_with("sig")) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      link.advance(SurfaceLoad{mesh.position}, {});
    }
    link.finish("{}");
    std::ofstream(run_.folder + "/load_done");
  }

  void play_structure(Participant& link) const {
    reach("structure", "join");
    const SurfaceMesh mesh = strip(200);
    link.offer_surface(mesh);
    reach("structure", "surface");
    link.keep(kept("structure"));
    link.ready({0.005, 0.0});
    while (const auto grant = link.next()) {
      reach("structure", "window " + std::to_string(grant->window));
      link.advance(SurfaceMotion{mesh.position, mesh.position}, {});
    }
    if (fault_.at_rest()) come_to_rest(link);
    link.finish("{}");
  }

  /// The load side has taken its leave when the fault comes; rest is never reached.
  void come_to_rest(Participant& link) const {
    eventually(10.0, [&] { return link.beat(), std::filesystem::exists(run_.folder + "/load_done"); });
    reach("structure", "rest");
    eventually(10.0, [&] { return link.beat(), false; });
  }

  const Fault& fault_;
  CoupledRun run_;
  pid_t broker_pid_ = 0;
  std::optional<Child> broker_, proxy_, load_, structure_;
};

}  // namespace standoff::test
