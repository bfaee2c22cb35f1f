#pragma once
// The broker's view of a whole run as a pure function: (state, event, now) -> (state, actions). No sockets, no clocks,
// no threads; every deadline is a number in SessionRules, so a minute of waiting is tested in microseconds.
//
//   participant:  absent -HELLO-> joined -SURFACE-> meshed -READY-> ready -(all ready)-> computing <-> waiting
//                 -(windows done)-> finishing -BYE-> closed          anything else: ABORT to all, first failure wins
//
// Arrays pass through as opaque handles.
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "coupling/session/messages.hpp"
#include "coupling/session/window_clock.hpp"

namespace standoff {

struct Payload;  // defined by the transport
using PayloadHandle = std::shared_ptr<const Payload>;

/// All in seconds; 0 switches `progress` off.
struct Deadlines {
  double join = 60.0;          // until everyone has said HELLO
  double beat_interval = 1.0;  // a side that was silent for this long sends BEAT
  double beat = 5.0;           // silence after which a participant is lost: its process is frozen or cut off
  double progress = 300.0;     // the process lives, but its solver has not moved for this long: stuck
  double notice = 5.0;         // waiting is reported after this long, and again each time
  double own_pause = 1.0;      // a broker that was itself stopped for longer blames nobody for that time
  double save = 25.0;          // an interrupted run may go on for this long to reach a window's end and save
};

/// When the sides are asked to save. A last checkpoint is always made before the structure comes to rest.
struct CheckpointRule {
  std::string folder;              // holds window-NUMBER folders; empty: never
  double every = 60.0;             // s of wall clock; 0: not by time
  std::int64_t every_windows = 0;  // 0: not by count
};

/// What one side wrote.
struct SavedSide {
  std::string name;
  std::int64_t bytes = 0;
  std::uint32_t checksum = 0;
};

/// The broker's half of a checkpoint: all that lies between the two sides at the end of a window.
struct InterfaceState {
  CouplingClock clock;  // clock.first: the next window
  std::string case_hash, surface_digest;
  InterfaceTotals given, received;
  std::int64_t bytes = 0;
  PayloadHandle motion, load;
  std::vector<SavedSide> sides;
};
struct ResumePoint {
  InterfaceState state;
  std::string folder;  // where both sides find their files
};

struct SessionRules {
  std::string token;
  std::vector<std::string> expected{"particles", "structure"};  // names, one of each role
  double until = 0.0;                                           // s
  bool parallel = true;
  WindowRule window;
  Deadlines deadlines;
  CheckpointRule checkpoint;
  std::optional<ResumePoint> resume;
};

enum class Stage { absent, joined, meshed, ready, computing, waiting, saving, finishing, closed };
constexpr std::size_t stage_count = 9;
const char* stage_name(Stage stage);
/// Whether a participant in `stage` may send a message of this kind (index in Message).
bool may_send(Stage stage, std::size_t kind);
/// "BEAT, ABORT": what may_send allows, for diagnostics.
std::string expected_in(Stage stage);

struct Peer {
  std::string address;  // of the connection, chosen by the transport
  std::string name, host;
  Role role = Role::load;
  std::int64_t pid = 0;
  std::uint32_t epoch = 0;
  Stage stage = Stage::joined;
  double stage_since = 0.0, last_seen = 0.0, last_sent = 0.0, progress_since = 0.0;  // s
  std::uint64_t progress = 0, received = 0, sent = 0;
  WindowNeeds needs;
  std::int64_t window = -1;  // last granted
  InterfaceTotals totals;
  bool keeps = false;
  std::optional<SavedSide> saved;  // in the checkpoint that is being made
};

struct SessionState {
  SessionRules rules;
  std::vector<Peer> peers;
  std::string case_hash;  // of the first that joined
  std::uint32_t epochs = 0;
  CouplingClock clock;  // windows == 0 until everyone is ready
  message::Surface surface;
  PayloadHandle surface_payload;
  PayloadHandle motion, load;  // handed in and not granted yet
  std::int64_t bytes = 0;      // of payload taken in
  double phase_since = 0.0, last_tick = 0.0, last_notice = 0.0, last_checkpoint = 0.0;
  std::int64_t checkpoint = -1;  // windows done at the last one, -1: none
  std::string stop_reason;       // interrupted: save at the next window's end, then stop
  std::string stop_origin;       // who was
  double stop_since = 0.0;
  std::optional<message::Abort> failure;
  std::string turned_away;  // the last that was rejected, and why: the likely cause if someone is missing
  bool over = false;
};

/// What happened.
struct Received {
  std::string address;
  Envelope envelope;
  Message body;
  std::vector<FieldShape> fields;
  PayloadHandle payload;
  std::int64_t bytes = 0;
};
struct Malformed {
  std::string address, reason;
};
struct Disconnected {
  std::string address;
};
struct Tick {};
struct Interrupted {
  std::string reason;
};
/// The broker's own half of a checkpoint is on disk.
struct Committed {};
/// The broker could not write a file.
struct DiskFailed {
  std::string reason;
};
using SessionEvent = std::variant<Received, Malformed, Disconnected, Tick, Interrupted, Committed, DiskFailed>;

/// What people and the launcher are told.
namespace announce {
struct Joined {
  std::string name;
  Role role = Role::load;
  std::int64_t pid = 0;
};
struct Rejected {
  std::string name, reason;
};
struct Clock {
  CouplingClock clock;
};
struct Waiting {
  std::vector<std::string> names;
  double since = 0.0;  // s
  std::string stage;   // what each was last doing
};
struct Progress {
  std::string name;
  NamedValues values;
};
struct Sample {
  std::string name;
  double time = 0.0;
  NamedValues values;
};
struct Report {
  std::string name, json;
};
struct Stopping {
  std::string name, reason;
  std::int64_t windows = 0;
};
struct Interface {
  std::int64_t bytes = 0;
  InterfaceTotals given, received;
};
struct Saving {
  std::string reason;  // of an interrupted run that is not left before it has saved
};
struct Checkpoint {
  std::int64_t windows = 0;  // done
  double time = 0.0;         // s
  std::int64_t bytes = 0;
};
struct Failed {
  message::Abort failure;
};
struct Done {};
}  // namespace announce
using Announcement =
    std::variant<announce::Joined, announce::Rejected, announce::Clock, announce::Waiting, announce::Progress,
                 announce::Sample, announce::Report, announce::Stopping, announce::Interface, announce::Saving,
                 announce::Checkpoint, announce::Failed, announce::Done>;

/// What is to be done.
struct Send {
  std::string address;
  Envelope envelope;
  Message body;
  PayloadHandle payload;
};
struct Announce {
  Announcement what;
};
/// Both sides have saved: add this and make it count, then say Committed.
struct Commit {
  InterfaceState state;
};
struct Finish {
  ExitCode code = ExitCode::done;
};
using SessionAction = std::variant<Send, Announce, Commit, Finish>;

struct SessionStep {
  SessionState state;
  std::vector<SessionAction> actions;
};

SessionState open_session(SessionRules rules, double now);
SessionStep step_session(SessionState state, const SessionEvent& event, double now);

}  // namespace standoff
