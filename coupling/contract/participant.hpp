#pragma once
// The whole coupling as a solver sees it. A participant's life:
//
//   Participant link(options);
//   link.offer_surface(mesh)            structure      |   mesh = link.receive_surface()      load
//   clock = link.ready(needs, motion)   blocks until every participant is ready
//   while (auto grant = link.next())    blocks; empty when the last window is done
//     ... compute the window grant->begin .. grant->begin + clock.window ...
//     link.advance(motion | load, progress)
//   link.finish(report)                 two-phase goodbye
//
// Heartbeats, deadlines and the peer's failures are handled inside: every blocking call throws Stop with the first cause.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/contract/surface.hpp"

namespace standoff {

enum class Role { load, structure };

struct ParticipantOptions {
  std::string name;         // "particles", "structure": unique in a run
  Role role = Role::load;
  std::string endpoint;     // "ipc:///tmp/.../broker" or "tcp://host:port"
  std::string token;        // run token, must match the broker's
  std::string case_hash;    // both sides must have read the same case
  std::string version;      // software version, for the record
};

/// What this side asks of the window; the broker decides.
struct WindowNeeds {
  double stable_step = 0.0;   // s, this side's own step at the start
  double window_limit = 0.0;  // s, largest window this side finds accurate; used with "auto"
};

/// The integer window is the clock: window k covers [k, k + 1) * window, k = 0 .. windows - 1.
struct CouplingClock {
  double window = 0.0;      // s
  std::int64_t windows = 0;
  bool parallel = true;     // load and motion of window k-1 feed window k; otherwise the load side goes first
};

struct Grant {
  std::int64_t window = 0;  // index
  double begin = 0.0;       // s, = window * length
  /// Parallel scheme: the structure is granted one more window after the last so that the last load is applied.
  bool drain = false;
  SurfaceMotion motion;     // load side: the structure's state at `begin`
  SurfaceLoad load;         // structure side: force to hold over this window
};

/// Named numbers for people and programs: a row of histories.csv or a progress line.
using NamedValues = std::vector<std::pair<std::string, double>>;

/// Interface ledger of one side for one window, full domain is not implied: as simulated.
struct InterfaceTotals {
  Vec3 impulse;       // N s given to (load side) or received by (structure side) the surface since the start
  double work = 0.0;  // J, likewise
};

class Participant {
 public:
  explicit Participant(ParticipantOptions options);  // connects and says HELLO
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  void offer_surface(const SurfaceMesh& mesh);
  SurfaceMesh receive_surface();
  CouplingClock ready(const WindowNeeds& needs);
  std::optional<Grant> next();

  void advance(const SurfaceMotion& motion, const InterfaceTotals& totals);
  void advance(const SurfaceLoad& load, const InterfaceTotals& totals);

  /// Sends a progress line (shown, not stored) or a history row (stored) with the next message. time in s.
  void progress(const NamedValues& values);
  void sample(double time, const NamedValues& values);
  /// Call now and then from long computations outside the window loop: keeps the heartbeat and notices a dead peer.
  void beat();

  /// Hands in the JSON fragment of run.json and says goodbye; returns when the broker has taken it.
  void finish(const std::string& report_json);
  /// Tells everyone the first cause; never throws.
  void abort(int exit_code, const std::string& reason) noexcept;

  /// Wall-clock seconds this side computed, waited for the peer, and spent in exchange; bytes both ways.
  struct Times {
    double compute = 0.0, wait = 0.0, exchange = 0.0;
    std::int64_t bytes = 0;
  };
  Times times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace standoff
