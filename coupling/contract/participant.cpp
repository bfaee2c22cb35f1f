#include "coupling/contract/participant.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

#include "coupling/base/stage_timer.hpp"
#include "coupling/contract/kept_file.hpp"
#include "coupling/contract/link.hpp"
#include "coupling/contract/surface_fields.hpp"
#include "coupling/contract/trace_log.hpp"
#include "coupling/output/atomic_file.hpp"

namespace standoff {
namespace {

template <class Body, std::size_t K = 0>
constexpr std::size_t kind() {
  if constexpr (std::is_same_v<Body, std::variant_alternative_t<K, Message>>)
    return K;
  else
    return kind<Body, K + 1>();
}

}  // namespace

struct Participant::Impl {
  explicit Impl(ParticipantOptions given) : options(std::move(given)), link(options) {
    if (!options.trace.empty()) trace.emplace();
  }

  ParticipantOptions options;
  Link link;
  std::string digest;
  std::vector<Vec3> rest;  // surface nodes at rest
  Grant grant;
  std::int64_t window = -1;
  bool computing = false, ended = false, finished = false;
  Stopwatch since_grant;
  Times times;
  std::int64_t earlier_bytes = 0;  // before this run was continued
  KeptState kept;
  std::optional<TraceLog> trace;
  const StageTimers* stages = nullptr;
  double waited = 0.0, granted_at = 0.0;  // us, for the trace

  [[noreturn]] void refuse(const std::string& what, const ProtocolError& error) {
    const message::Abort failure{"broker", ExitCode::participant_lost, fmt::format("{}: {}", what, error.what()),
                                 window};
    fail(failure);
  }
  [[noreturn]] void stop_by_guard(const std::string& reason) {
    const message::Abort failure{options.name, ExitCode::guard, reason, window};
    fail(failure);
  }
  [[noreturn]] void fail(const message::Abort& failure) {
    link.fail(failure);
    const message::Abort first = link.failure().value_or(failure);
    throw Stop(first.code, first_cause(first));
  }
  Parcel await(std::initializer_list<std::size_t> kinds) {
    link.moved();
    const Stopwatch watch;
    Parcel parcel = link.await(kinds);
    times.wait += watch.seconds();
    waited = 1e6 * watch.seconds();
    return parcel;
  }
  void advance(const Payload& payload, const InterfaceTotals& totals) {
    link.send(message::Advance{window, totals, times.compute, times.wait}, &payload);
    computing = false;
  }
  KeptFile kept_file(std::int64_t windows) const { return {options.case_hash, options.name, windows}; }
  /// Answers CHECKPOINT.
  void save(const message::Checkpoint& order) {
    const Stopwatch watch;
    if (!kept.save) throw std::logic_error("CHECKPOINT without keep()");
    times.bytes = earlier_bytes + link.bytes();
    StateWriter own;
    own(times);
    const auto [bytes, checksum] = kept_file(order.windows).write(order.folder, own.bytes() + kept.save());
    link.send(message::Saved{order.windows, bytes, checksum});
    times.exchange += watch.seconds();
  }
  void take_up(const message::Start& start) {
    const std::string state = kept_file(start.clock.first).read(start.folder, start.checksum);
    StateWriter own;
    own(times);
    if (!kept.restore || state.size() < own.bytes().size()) throw_longer_state();
    StateReader(std::span(state).first(own.bytes().size()))(times);
    earlier_bytes = times.bytes;
    kept.restore(std::span(state).subspan(own.bytes().size()));
  }
  /// Books the time since the grant; true if there is a window to hand in.
  void begin_advance() {
    link.moved();
    if (!computing) throw std::logic_error("advance() without a window: call next() first");
    times.compute += since_grant.seconds();
    if (trace) trace->window(window, waited, granted_at, TraceLog::now(), stages);
  }
};

Participant::Participant(ParticipantOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}

Participant::~Participant() {
  // After a failure that was told, or a proper goodbye, this is without effect.
  if (!impl_->finished) abort(static_cast<int>(ExitCode::participant_lost), "left the run before its end");
}

void Participant::offer_surface(const SurfaceMesh& mesh) {
  Impl& my = *impl_;
  my.link.moved();
  if (const std::string objection = objection_to(mesh); !objection.empty()) my.stop_by_guard(objection);
  const Payload payload = to_fields(mesh);
  my.digest = surface_digest(payload);
  my.rest = mesh.position;
  my.link.send(message::Surface{static_cast<std::int64_t>(mesh.position.size()),
                                static_cast<std::int64_t>(mesh.quads.size()), my.digest},
               &payload);
}

SurfaceMesh Participant::receive_surface() {
  Impl& my = *impl_;
  const Parcel parcel = my.await({kind<message::Surface>()});
  const auto& surface = std::get<message::Surface>(parcel.body);
  try {
    const Payload none;
    const Payload& payload = parcel.payload ? *parcel.payload : none;
    SurfaceMesh mesh = mesh_from(payload, surface.nodes, surface.quads);
    my.digest = surface_digest(payload);
    my.rest = mesh.position;
    return mesh;
  } catch (const ProtocolError& error) {
    my.refuse("the surface that was received", error);
  }
}

CouplingClock Participant::ready(const WindowNeeds& needs) {
  Impl& my = *impl_;
  my.link.moved();
  my.link.flush_progress();
  my.link.send(message::Ready{needs, my.digest});
  const Parcel parcel = my.await({kind<message::Start>()});
  const auto& start = std::get<message::Start>(parcel.body);
  if (start.clock.first > 0) my.take_up(start);
  my.link.set_between_windows(true);
  if (my.trace) my.trace->begin(my.stages);
  return start.clock;
}

void Participant::trace_stages(const StageTimers& stages) {
  impl_->stages = &stages;
}

void Participant::keep(KeptState state) {
  impl_->kept = std::move(state);
}

void Participant::throw_longer_state() {
  throw Stop(ExitCode::checkpoint_incompatible,
             "the saved state does not fit: it was written by another version of this program");
}

const Grant* Participant::next() {
  Impl& my = *impl_;
  if (my.computing) throw std::logic_error(fmt::format("next() before advance() of window {}", my.window));
  if (my.ended) return nullptr;
  const std::initializer_list<std::size_t> kinds = {kind<message::Grant>(), kind<message::StopWindows>(),
                                                    kind<message::Checkpoint>()};
  Parcel parcel = my.await(kinds);
  while (const auto* order = std::get_if<message::Checkpoint>(&parcel.body)) {
    my.save(*order);
    parcel = my.await(kinds);
  }
  const Stopwatch watch;
  const auto* granted = std::get_if<message::Grant>(&parcel.body);
  if (granted == nullptr) {
    my.ended = true;
    my.link.set_between_windows(false);
    return nullptr;
  }
  Grant& grant = my.grant;
  grant.window = my.window = granted->window;
  grant.begin = granted->begin;
  grant.drain = granted->drain;
  my.link.set_window(my.window);
  try {
    const std::size_t nodes = my.rest.size();
    if (my.options.role == Role::load) {
      if (parcel.payload)
        take_motion(*parcel.payload, nodes, grant.motion);
      else
        grant.motion = {my.rest, std::vector<Vec3>(nodes)};
    } else {
      if (parcel.payload)
        take_load(*parcel.payload, nodes, grant.load);
      else
        grant.load.force.assign(nodes, Vec3{});
    }
  } catch (const ProtocolError& error) {
    my.refuse(my.options.role == Role::load ? "the motion of the structure" : "the load on the structure", error);
  }
  my.computing = true;
  my.times.exchange += watch.seconds();
  my.since_grant = Stopwatch();
  if (my.trace) my.granted_at = TraceLog::now();
  return &grant;
}

void Participant::request_stop(const std::string& reason) {
  impl_->link.moved();
  impl_->link.send(message::StopWindows{0, reason});
}

void Participant::advance(const SurfaceMotion& motion, const InterfaceTotals& totals) {
  impl_->begin_advance();
  const Stopwatch watch;
  const Payload payload = to_fields(motion);
  if (!payload.finite())
    for (const std::string& text :
         {not_finite("surface position", motion.position), not_finite("surface velocity", motion.velocity)})
      if (!text.empty()) impl_->stop_by_guard(text + ": the structure is unstable");
  impl_->advance(payload, totals);
  impl_->times.exchange += watch.seconds();
}

void Participant::advance(const SurfaceLoad& load, const InterfaceTotals& totals) {
  impl_->begin_advance();
  const Stopwatch watch;
  const Payload payload = to_fields(load);
  if (!payload.finite())
    impl_->stop_by_guard(not_finite("force on the surface", load.force) + ": the load side is unstable");
  impl_->advance(payload, totals);
  impl_->times.exchange += watch.seconds();
}

void Participant::progress(const NamedValues& values) {
  impl_->link.moved();
  impl_->link.show(values);
}

void Participant::sample(double time, const NamedValues& values) {
  impl_->link.moved();
  impl_->link.send(message::Sample{time, values});
}

void Participant::beat() {
  impl_->link.moved();
}

void Participant::finish(const std::string& report_json) {
  Impl& my = *impl_;
  my.link.moved();
  my.link.flush_progress();
  if (my.trace) write_atomically(my.options.trace, my.trace->lines(my.options.name, getpid()));
  my.link.send(message::Report{report_json});
  my.link.send(message::Bye{});
  my.await({kind<message::ByeAck>()});
  my.link.close();
  my.finished = true;
}

void Participant::abort(int exit_code, const std::string& reason) noexcept {
  try {
    impl_->link.fail({impl_->options.name, static_cast<ExitCode>(exit_code), reason, impl_->window});
  } catch (...) {
    // Out of memory for two strings: the broker sees the connection end.
  }
}

void Participant::throw_first_cause() const {
  if (const auto failure = impl_->link.failure()) throw Stop(failure->code, first_cause(*failure));
}

Participant::Times Participant::times() const {
  Times times = impl_->times;
  times.bytes = impl_->earlier_bytes + impl_->link.bytes();
  return times;
}

}  // namespace standoff
