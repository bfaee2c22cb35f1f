#include "coupling/conform/play.hpp"

#include <cmath>

#include <fmt/format.h>

#include "coupling/contract/surface_fields.hpp"
#include "coupling/session/window_clock.hpp"

namespace standoff::conform {
namespace {

constexpr double gentle_pressure = 1e6;  // Pa, far below what yields a plate within a few windows

/// The face of the plate as 8 x 8 quads; a quarter of it if the case says so.
SurfaceMesh flat_plate(const CaseSpec& spec) {
  constexpr int side = 9;
  const bool quarter = spec.run.quarter_symmetry;
  const Vec3 size = spec.plate.size;
  const Vec3 low = quarter ? Vec3{} : Vec3{-0.5 * size.x, -0.5 * size.y, 0.0};
  const double lx = (quarter ? 0.5 : 1.0) * size.x / (side - 1), ly = (quarter ? 0.5 : 1.0) * size.y / (side - 1);
  SurfaceMesh mesh;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      mesh.position.push_back({low.x + i * lx, low.y + j * ly, 0.0});
      const double share = (i % (side - 1) == 0 ? 0.5 : 1.0) * (j % (side - 1) == 0 ? 0.5 : 1.0);
      mesh.node_mass.push_back(share * spec.plate.material.density * size.z * lx * ly);
      const int at = j * side + i;
      if (i + 1 < side && j + 1 < side) mesh.quads.push_back({at, at + 1, at + side + 1, at + side});
    }
  return mesh;
}

/// The right-hand normals must point to the charge, before a plate as in a pipe.
void check_normals(const SurfaceMesh& mesh, const Vec3& charge) {
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    const auto& c = mesh.quads[q];
    const auto at = [&](std::size_t corner) { return mesh.position[static_cast<std::size_t>(c[corner])]; };
    const Vec3 normal = cross(at(2) - at(0), at(3) - at(1));
    if (!(dot(normal, charge - 0.25 * (at(0) + at(1) + at(2) + at(3))) > 0.0))
      throw RuleBroken(fmt::format("quad {} is clockwise or empty seen from the charge", q));
  }
}

}  // namespace

void Play::hello() {
  const Parcel parcel = peer.expect<message::Hello>();
  const auto& hello = std::get<message::Hello>(parcel.body);
  role = hello.role;
  keeps = hello.keeps;
  if (hello.name.empty()) throw RuleBroken("HELLO without a name");
  if (hello.name != parcel.envelope.sender)
    throw RuleBroken(fmt::format("HELLO of \"{}\" is sent by \"{}\"", hello.name, parcel.envelope.sender));
}

void Play::welcome(double beat_deadline, const Counterpart::Spoil& spoil) {
  peer.set_beat_interval(0.2 * beat_deadline);
  peer.say(message::Welcome{1, 0.2 * beat_deadline, beat_deadline}, nullptr, spoil);
}

void Play::surface() {
  if (is_structure()) {
    const Parcel parcel = peer.expect<message::Surface>();
    const auto& surface = std::get<message::Surface>(parcel.body);
    try {
      const Payload none;
      const Payload& payload = parcel.payload ? *parcel.payload : none;
      mesh = mesh_from(payload, surface.nodes, surface.quads);
      digest = surface_digest(payload);
    } catch (const ProtocolError& error) {
      throw RuleBroken(std::string("SURFACE: ") + error.what());
    }
    if (digest != surface.digest)
      throw RuleBroken(fmt::format("SURFACE says digest {}, its fields give {}", surface.digest, digest));
    check_normals(mesh, {0.0, 0.0, subject.spec.run.stand_off});
  } else {
    mesh = flat_plate(subject.spec);
    const Payload payload = to_fields(mesh);
    digest = surface_digest(payload);
    peer.say(message::Surface{static_cast<std::int64_t>(mesh.position.size()),
                              static_cast<std::int64_t>(mesh.quads.size()), digest},
             &payload);
  }
}

void Play::ready() {
  const Parcel parcel = peer.expect<message::Ready>(60.0);  // packing a large charge takes its time
  const auto& ready = std::get<message::Ready>(parcel.body);
  needs = ready.needs;
  if (ready.surface_digest != digest)
    throw RuleBroken(fmt::format("READY says surface {}, that of SURFACE is {}", ready.surface_digest, digest));
  if (!(needs.stable_step > 0.0) || !std::isfinite(needs.stable_step) || !(needs.window_limit >= 0.0))
    throw RuleBroken(
        fmt::format("READY says stable_step {} s, window_limit {} s", needs.stable_step, needs.window_limit));
  window = std::max(needs.stable_step, needs.window_limit);
}

void Play::start(std::int64_t count) {
  message::Start start;
  start.clock.window = window;
  start.clock.windows = count;
  peer.say(start);
}

void Play::start_again(std::int64_t count, const std::string& folder, const message::Saved& saved) {
  message::Start start;
  start.clock.window = window;
  start.clock.windows = count;
  start.clock.first = saved.windows;
  start.folder = folder;
  start.checksum = saved.checksum;
  peer.set_window(saved.windows - 1);
  peer.say(start);
}

void Play::begin(std::int64_t count, double beat_deadline) {
  hello();
  welcome(beat_deadline);
  surface();
  ready();
  start(count);
}

std::vector<Vec3> Play::usual_force(std::int64_t k) const {
  double mass = 0.0;
  for (const double m : mesh.node_mass) mass += m;
  const double area = subject.spec.plate.size.x * subject.spec.plate.size.y / subject.spec.copies();
  std::vector<Vec3> force;
  for (std::size_t i = 0; i < mesh.position.size(); ++i) {
    // Differs from node to node and from window to window, with a tangential part.
    const double share = gentle_pressure * area * mesh.node_mass[i] / mass;
    const double wave = std::cos(0.7 * static_cast<double>(i) + static_cast<double>(k));
    force.push_back({0.1 * share * wave, -0.05 * share * wave, -share * (1.0 + 0.5 * wave)});
  }
  return force;
}

Payload Play::usual_field(std::int64_t k) const {
  if (is_structure()) return to_fields(SurfaceLoad{usual_force(k)});
  return to_fields(SurfaceMotion{mesh.position, std::vector<Vec3>(mesh.position.size())});
}

void Play::grant(std::int64_t k, bool drain, const Counterpart::Spoil& spoil) {
  peer.set_window(k);
  const message::Grant body{k, static_cast<double>(k) * window, drain};
  if (k == 0) return peer.say(body, nullptr, spoil);
  const Payload payload = usual_field(k);
  peer.say(body, &payload, spoil);
}

void Play::grant_with(std::int64_t k, const Payload& payload, const Counterpart::Spoil& spoil) {
  peer.set_window(k);
  peer.say(message::Grant{k, static_cast<double>(k) * window, false}, &payload, spoil);
}

void Play::advance(std::int64_t k) {
  const Parcel parcel = peer.expect<message::Advance>();
  const auto& advance = std::get<message::Advance>(parcel.body);
  if (advance.window != k) throw RuleBroken(fmt::format("ADVANCE of window {}, granted was {}", advance.window, k));
  if (parcel.envelope.window != k)
    throw RuleBroken(fmt::format("ADVANCE of window {} says window {} in its envelope", k, parcel.envelope.window));
  try {
    const Payload none;
    const Payload& payload = parcel.payload ? *parcel.payload : none;
    if (payload.fields.size() != (is_structure() ? 2u : 1u))
      throw ProtocolError(fmt::format("{} fields", payload.fields.size()));
    if (is_structure())
      take_motion(payload, mesh.position.size(), motion);
    else
      take_load(payload, mesh.position.size(), load);
  } catch (const ProtocolError& error) {
    throw RuleBroken(fmt::format("ADVANCE of window {}: {}", k, error.what()));
  }
  totals = advance.totals;
}

void Play::stop() {
  peer.say(message::StopWindows{1, "all windows are done"});
}

void Play::goodbye() {
  const Parcel parcel = peer.expect<message::Report>(60.0);
  report = nlohmann::json::parse(std::get<message::Report>(parcel.body).json, nullptr, false);
  if (!report.is_object()) throw RuleBroken("REPORT is not a JSON object");
  peer.expect<message::Bye>();
  peer.expect_quiet(0.2);  // it stays until BYE_ACK
  peer.say(message::ByeAck{});
  const ProcessEnd end = peer.wait_end(10.0);
  if (end.by_signal || end.number != 0)
    throw RuleBroken(fmt::format("after BYE_ACK it ended with {} {}, saying {}", end.by_signal ? "signal" : "status",
                                 end.number, peer.said()));
}

}  // namespace standoff::conform
