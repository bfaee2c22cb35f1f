#pragma once
// What the processes say to each other, as plain data: the C++ twin of proto/*.proto without its encoding. Arrays
// travel beside a message as fields; here only their shapes are known.
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "coupling/base/stop.hpp"
#include "coupling/base/vec3.hpp"

namespace standoff {

enum class Role { load, structure };

/// What one side asks of the window; the broker decides.
struct WindowNeeds {
  double stable_step = 0.0;   // s, this side's own step at the start
  double window_limit = 0.0;  // s, largest window this side finds accurate; used with "auto"; 0: no opinion
};

/// The integer window is the clock: window k covers [k, k + 1) * window, k = 0 .. windows - 1.
struct CouplingClock {
  double window = 0.0;  // s
  std::int64_t windows = 0;
  bool parallel = true;    // load and motion of window k-1 feed window k; otherwise the load side goes first
  std::int64_t first = 0;  // window that a continued run goes on with
};

/// Named numbers for people and programs: a row of histories.csv or a progress line.
using NamedValues = std::vector<std::pair<std::string, double>>;

/// Interface ledger of one side since the start; full domain is not implied: as simulated.
struct InterfaceTotals {
  Vec3 impulse;       // N s given to (load side) or received by (structure side) the surface
  double work = 0.0;  // J, likewise
};

enum class DataType { f64, i32 };

/// Shape of an array that travels with a message: count x components values.
struct FieldShape {
  std::string name;
  DataType type = DataType::f64;
  std::int64_t components = 1;
  std::int64_t count = 0;
  friend bool operator==(const FieldShape&, const FieldShape&) = default;
};

namespace message {

struct Hello {
  std::string name;
  Role role = Role::load;
  std::string software_version, case_hash;
  std::int64_t pid = 0;
  std::string host;
  bool keeps = false;  // can save its state and go on from it
};
struct Welcome {
  std::uint32_t epoch = 0;
  double beat_interval = 1.0, beat_deadline = 5.0;  // s
};
struct Reject {
  ExitCode code = ExitCode::bad_case;
  std::string reason, remedy;
};
struct Surface {
  std::int64_t nodes = 0, quads = 0;
  std::string digest;
};
struct Ready {
  WindowNeeds needs;
  std::string surface_digest;
};
struct Start {
  CouplingClock clock;
  std::string folder;          // of the checkpoint to go on from, if clock.first > 0
  std::uint32_t checksum = 0;  // of this participant's file in it
};
struct Grant {
  std::int64_t window = 0;
  double begin = 0.0;  // s
  bool drain = false;
};
struct Advance {
  std::int64_t window = 0;
  InterfaceTotals totals;
  double compute = 0.0, wait = 0.0;  // s of wall clock since the start
};
struct StopWindows {
  std::int64_t windows = 0;
  std::string reason;
  bool interrupted = false;  // a signal: save first where that is possible, then end with 130
};
struct Beat {
  std::uint64_t progress = 0;
};
struct Abort {
  std::string origin;
  ExitCode code = ExitCode::participant_lost;
  std::string reason;
  std::int64_t window = -1;
};
struct Bye {};
struct ByeAck {};
struct Progress {
  NamedValues values;
};
struct Sample {
  double time = 0.0;  // s
  NamedValues values;
};
struct Report {
  std::string json;
};
struct Checkpoint {
  std::int64_t windows = 0;  // done
  std::string folder;
};
struct Saved {
  std::int64_t windows = 0, bytes = 0;
  std::uint32_t checksum = 0;
};

}  // namespace message

/// In the order of the wire's body tags; message_name and the table of legal messages follow it.
using Message = std::variant<message::Hello, message::Welcome, message::Reject, message::Surface, message::Ready,
                             message::Start, message::Grant, message::Advance, message::StopWindows, message::Beat,
                             message::Abort, message::Bye, message::ByeAck, message::Progress, message::Sample,
                             message::Report, message::Checkpoint, message::Saved>;
constexpr std::size_t message_kinds = std::variant_size_v<Message>;

/// "HELLO", "GRANT", ...
const char* message_name(std::size_t kind);
inline const char* message_name(const Message& body) {
  return message_name(body.index());
}
const char* role_name(Role role);

/// Who speaks, and which message of the connection this is.
struct Envelope {
  std::string token;
  std::uint32_t epoch = 0;
  std::uint64_t sequence = 0;
  std::string sender;
  std::int64_t window = -1;
};

/// The first failure as everyone prints it.
std::string first_cause(const message::Abort& failure);

}  // namespace standoff
