#include "coupling/replay/replay.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "coupling/base/state_hash.hpp"
#include "coupling/base/stop.hpp"

namespace standoff {
namespace {

constexpr double nearly = 1e-9;  // of a window: times that a rounding error apart are the same

/// Rows of histories.csv fall on the same times as those of the other side.
class Rows {
 public:
  explicit Rows(double interval) : interval_(interval) {}
  bool due(double time, double window) {
    if (time + 0.5 * window < static_cast<double>(next_) * interval_) return false;
    next_ = static_cast<long>((time + 0.5 * window) / interval_) + 1;
    return true;
  }

 private:
  double interval_;
  long next_ = 0;
};

std::string report_of(const StateHash& hash, const Participant::Times& times, Role role) {
  const char* side = role == Role::load ? "particle" : "structure";
  return fmt::format(
      "{{\"replayed\": \"{}\", \"timing\": {{\"{}\": {{\"compute_s\": {}, \"wait_s\": {}, \"exchange_s\": "
      "{}}}}}, \"provenance\": {{\"state_hash\": \"{}\"}}}}",
      role_name(role), side, times.compute, times.wait, times.exchange, hash.hex());
}

}  // namespace

const TapeFrame& ReplayedSide::recorded(std::int64_t window) {
  for (const TapeFrame& frame : near_)
    if (frame.window == window) return frame;
  const std::ptrdiff_t entry = tape_.find(role_, window);
  if (entry < 0)
    throw Stop(ExitCode::bad_case,
               fmt::format("tape {} holds {} windows of the {} side; window {} is asked for: let the "
                           "run end earlier (run.until) or record longer",
                           tape_.path(), tape_.windows(role_), role_name(role_), window));
  if (near_.size() > 1) near_.erase(near_.begin());
  near_.push_back(tape_.frame(tape_.entries()[static_cast<std::size_t>(entry)]));
  return near_.back();
}

TapeFrame ReplayedSide::load_over(double begin, double end) {
  const double length = tape_.head().clock.window;
  TapeFrame sum;
  auto first = static_cast<std::int64_t>(begin / length + nearly);
  for (std::int64_t k = first; static_cast<double>(k) * length < end - nearly * length; ++k) {
    const TapeFrame& part = recorded(k);
    const double from = std::max(begin, static_cast<double>(k) * length);
    const double to = std::min(end, static_cast<double>(k + 1) * length), share = (to - from) / (end - begin);
    sum.force.resize(part.force.size());
    for (std::size_t n = 0; n < sum.force.size(); ++n) sum.force[n] += part.force[n] * share;
    const double done = (to - static_cast<double>(k) * length) / length;
    const InterfaceTotals before = k > 0 ? recorded(k - 1).totals : InterfaceTotals{};
    const InterfaceTotals after = recorded(k).totals;
    sum.totals = {before.impulse + (after.impulse - before.impulse) * done,
                  before.work + (after.work - before.work) * done};
  }
  return sum;
}

TapeFrame ReplayedSide::motion_at(double time) {
  const double length = tape_.head().clock.window;
  const auto k = static_cast<std::int64_t>(std::ceil(time / length - nearly)) - 1;  // frame k is at (k + 1) length
  TapeFrame after = recorded(std::max<std::int64_t>(k, 0));
  const double s = time / length - static_cast<double>(k);  // in (0, 1]
  if (k < 0 || std::abs(s - 1.0) < nearly) return after;
  TapeFrame before;
  before.position = tape_.head().surface.position, before.velocity.resize(before.position.size());
  if (k > 0) before = recorded(k - 1);
  TapeFrame now = after;
  const double a = 1.0 - 3.0 * s * s + 2.0 * s * s * s, b = s - 2.0 * s * s + s * s * s, c = s * s * s - s * s;
  const double da = 6.0 * (s * s - s), db = 1.0 - 4.0 * s + 3.0 * s * s, dc = 3.0 * s * s - 2.0 * s;
  for (std::size_t n = 0; n < now.position.size(); ++n) {
    const Vec3 way = after.position[n] - before.position[n];
    const Vec3 &v0 = before.velocity[n], &v1 = after.velocity[n];
    now.position[n] = before.position[n] + way * (1.0 - a) + (v0 * b + v1 * c) * length;
    now.velocity[n] = way * (-da / length) + v0 * db + v1 * dc;
  }
  now.totals = {before.totals.impulse + (after.totals.impulse - before.totals.impulse) * s,
                before.totals.work + (after.totals.work - before.totals.work) * s};
  return now;
}

TapeFrame ReplayedSide::at(const CouplingClock& clock, std::int64_t window) {
  if (clock.window == tape_.head().clock.window) return recorded(window);
  const double begin = static_cast<double>(window) * clock.window, end = begin + clock.window;
  return role_ == Role::load ? load_over(begin, end) : motion_at(end);
}

std::string surface_objection(const SurfaceMesh& recorded, const SurfaceMesh& surface) {
  if (recorded.position.size() != surface.position.size() || recorded.quads != surface.quads)
    return fmt::format(
        "the tape was recorded on a surface of {} nodes and {} quads, this one has {} and {}: use the "
        "same plate.elements and run.symmetry",
        recorded.position.size(), recorded.quads.size(), surface.position.size(), surface.quads.size());
  for (std::size_t n = 0; n < surface.position.size(); ++n)
    if (norm(recorded.position[n] - surface.position[n]) > 1e-9)
      return fmt::format("surface node {} lies {:.3g} m from where the tape has it: use the same plate.size", n,
                         norm(recorded.position[n] - surface.position[n]));
  return {};
}

void replay_load(const CaseSpec& spec, TapeReader& tape, Participant& link) {
  const std::string objection = surface_objection(tape.head().surface, link.receive_surface());
  if (!objection.empty()) throw Stop(ExitCode::bad_case, objection);
  const CouplingClock clock = link.ready(tape.head().load_needs);
  ReplayedSide side(tape, Role::load);
  Rows rows(spec.observe.interval);
  StateHash hash;
  const double full = spec.copies();
  const auto row = [&](double time, const InterfaceTotals& totals) {
    if (rows.due(time, clock.window))
      link.sample(
          time,
          {{"time_s", time}, {"impulse_Ns", -full * totals.impulse.z}, {"work_to_structure_J", full * totals.work}});
  };
  row(0.0, {});
  while (const auto grant = link.next()) {
    const TapeFrame frame = side.at(clock, grant->window);
    hash.add(std::span<const Vec3>(frame.force));
    const double end = grant->begin + clock.window;
    row(end, frame.totals);
    link.progress({{"time_s", end}, {"impulse_Ns", -full * frame.totals.impulse.z}});
    link.advance(SurfaceLoad{frame.force}, frame.totals);
  }
  link.finish(report_of(hash, link.times(), Role::load));
}

void replay_structure(const CaseSpec& spec, TapeReader& tape, Participant& link) {
  link.offer_surface(tape.head().surface);
  const CouplingClock clock = link.ready(tape.head().structure_needs);
  ReplayedSide side(tape, Role::structure);
  Rows rows(spec.observe.interval);
  StateHash hash;
  const auto row = [&](double time, const InterfaceTotals& totals) {
    if (rows.due(time, clock.window)) link.sample(time, {{"external_work_J", spec.copies() * totals.work}});
  };
  row(0.0, {});
  while (const auto grant = link.next()) {
    // Nobody looks at the motion after the drain; a tape of the serial scheme has none.
    const bool missing = grant->drain && tape.find(Role::structure, grant->window) < 0;
    const std::int64_t window = missing ? grant->window - 1 : grant->window;
    const TapeFrame frame = side.at(clock, window);
    if (!grant->drain) row(grant->begin + clock.window, frame.totals);
    hash.add(std::span<const Vec3>(frame.position));
    link.advance(SurfaceMotion{frame.position, frame.velocity}, frame.totals);
  }
  link.finish(report_of(hash, link.times(), Role::structure));
}

}  // namespace standoff
