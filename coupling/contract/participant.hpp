#pragma once
// The whole coupling as a solver sees it. A participant's life:
//
//   Participant link(options);
//   link.offer_surface(mesh)            structure      |   mesh = link.receive_surface()      load
//   link.keep(state)                    optional: what `state` lists is saved at checkpoints, and read by ready()
//   clock = link.ready(needs)           blocks until every participant is ready; clock.first > 0: a run is continued
//   while (auto grant = link.next())    blocks; null when the last window is done
//     ... compute the window grant->begin .. grant->begin + clock.window ...
//     link.advance(motion | load, progress)
//   link.finish(report)                 two-phase goodbye
//
// Heartbeats, deadlines and the peer's failures are handled inside: every blocking call throws Stop with the first
// cause. A background thread keeps the heartbeat while the solver computes. If the run has failed and the solver does
// not call back within `leave_within`, that thread prints the first cause and ends the process.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "coupling/base/stage_timer.hpp"
#include "coupling/base/state_archive.hpp"
#include "coupling/contract/surface.hpp"
#include "coupling/session/messages.hpp"  // Role, WindowNeeds, CouplingClock, NamedValues, InterfaceTotals
#include "coupling/transport/curve_keys.hpp"

namespace standoff {

struct ParticipantOptions {
  std::string name;  // "particles", "structure": unique in a run
  Role role = Role::load;
  std::string endpoint;         // "ipc:///tmp/.../broker" or "tcp://host:port"
  std::string token;            // run token, must match the broker's
  std::string case_hash;        // both sides must have read the same case
  std::string version;          // software version, for the record
  double join_deadline = 60.0;  // s to wait for a broker that is not there yet
  double leave_within = 3.0;    // s a solver may go on computing after the first failure
  std::string trace = {};       // file for what was done when (trace_log.hpp); empty: none
  bool keeps = false;           // calls keep(): takes part in checkpoints
  CurveKeys keys = {};          // for a broker on another host; or
  bool insecure = false;        // go to another host unencrypted
  /// What to do after that; empty: print "standoff-NAME: error: TEXT" and end the process with the code.
  std::function<void(ExitCode, const std::string& text)> end_process = nullptr;
};

struct Grant {
  std::int64_t window = 0;  // index
  double begin = 0.0;       // s, = window * length
  /// Parallel scheme: the structure is granted one more window after the last so that the last load is applied.
  bool drain = false;
  SurfaceMotion motion;  // load side: the structure's state at `begin`; window 0: the surface at rest
  SurfaceLoad load;      // structure side: force to hold over this window; window 0 in the parallel scheme: zero
};

/// Writes and reads all that outlives a window; see Participant::keep.
struct KeptState {
  std::function<std::string()> save;
  std::function<void(std::span<const char>)> restore;
};

class Participant {
 public:
  explicit Participant(ParticipantOptions options);  // connects and says HELLO
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  void offer_surface(const SurfaceMesh& mesh);
  SurfaceMesh receive_surface();
  /// `state(archive)` lists what outlives a window, once for writing and reading (base/state_archive.hpp). It is called
  /// inside ready() and next() only.
  template <class State>
  void keep(State state) {
    keep(KeptState{[state] {
                     StateWriter writer;
                     state(writer);
                     return writer.bytes();
                   },
                   [state](std::span<const char> bytes) {
                     StateReader reader(bytes);
                     state(reader);
                     if (!reader.at_end()) throw_longer_state();
                   }});
  }
  void keep(KeptState state);
  /// Stages that a trace shows inside a window; they must outlive the windows.
  void trace_stages(const StageTimers& stages);
  CouplingClock ready(const WindowNeeds& needs);
  /// Null when the last window is done. What it points to is overwritten by the next call.
  const Grant* next();
  /// Asks that no window beyond those already begun be computed; `next` then ends the loop on both sides.
  void request_stop(const std::string& reason);

  /// Hands in the window. Throws Stop(guard), and tells everyone, if a value is not finite.
  void advance(const SurfaceMotion& motion, const InterfaceTotals& totals);
  void advance(const SurfaceLoad& load, const InterfaceTotals& totals);

  /// Sends a progress line (shown, not stored; at most ten a second, the latest wins) or a history row (stored). time
  /// in s.
  void progress(const NamedValues& values);
  void sample(double time, const NamedValues& values);
  /// Call now and then from long computations outside the window loop: keeps the heartbeat and notices a dead peer.
  void beat();

  /// Hands in the JSON fragment of run.json and says goodbye; returns when the broker has taken it.
  void finish(const std::string& report_json);
  /// Tells everyone the first cause; never throws.
  void abort(int exit_code, const std::string& reason) noexcept;
  /// Throws Stop with the first cause, if the run has failed: a failure of our own may be the consequence of another.
  void throw_first_cause() const;

  /// Wall-clock seconds this side computed, waited for the peer, and spent in exchange; bytes both ways.
  struct Times {
    double compute = 0.0, wait = 0.0, exchange = 0.0;
    std::int64_t bytes = 0;
  };
  Times times() const;

 private:
  [[noreturn]] static void throw_longer_state();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace standoff
