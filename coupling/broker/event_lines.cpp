#include "coupling/broker/event_lines.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace standoff {
namespace {

using Json = nlohmann::ordered_json;

Json object(const NamedValues& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = value;
  return json;
}

Json array(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json report_of(const announce::Report& event) {
  Json report = Json::parse(event.json, nullptr, false);
  if (!report.is_object())
    throw Stop(ExitCode::participant_lost,
               fmt::format("the report of \"{}\" is not a JSON object: {:.60}", event.name, event.json));
  return report;
}

struct ToJson {
  Json operator()(const announce::Joined& e) const {
    return {{"event", "joined"}, {"name", e.name}, {"role", role_name(e.role)}, {"pid", e.pid}};
  }
  Json operator()(const announce::Rejected& e) const {
    return {{"event", "rejected"}, {"name", e.name}, {"reason", e.reason}};
  }
  Json operator()(const announce::Clock& e) const {
    return {{"event", "clock"},
            {"window_s", e.clock.window},
            {"windows", e.clock.windows},
            {"scheme", e.clock.parallel ? "parallel" : "serial"}};
  }
  Json operator()(const announce::Waiting& e) const {
    return {{"event", "waiting"}, {"for", e.names}, {"since_s", e.since}, {"stage", e.stage}};
  }
  Json operator()(const announce::Progress& e) const {
    return {{"event", "progress"}, {"name", e.name}, {"values", object(e.values)}};
  }
  Json operator()(const announce::Sample& e) const {
    return {{"event", "sample"}, {"name", e.name}, {"time_s", e.time}, {"values", object(e.values)}};
  }
  Json operator()(const announce::Report& e) const {
    return {{"event", "report"}, {"name", e.name}, {"report", report_of(e)}};
  }
  Json operator()(const announce::Stopping& e) const {
    return {{"event", "stopping"}, {"name", e.name}, {"reason", e.reason}, {"windows", e.windows}};
  }
  Json operator()(const announce::Interface& e) const {
    return {{"event", "interface"},
            {"bytes", e.bytes},
            {"impulse_given_Ns", array(e.given.impulse)},
            {"impulse_received_Ns", array(e.received.impulse)},
            {"work_given_J", e.given.work},
            {"work_received_J", e.received.work}};
  }
  Json operator()(const announce::Saving& e) const { return {{"event", "saving"}, {"reason", e.reason}}; }
  Json operator()(const announce::Checkpoint& e) const {
    return {{"event", "checkpoint"}, {"windows", e.windows}, {"time_s", e.time}, {"bytes", e.bytes}};
  }
  Json operator()(const announce::Failed& e) const {
    return {{"event", "failed"},
            {"origin", e.failure.origin},
            {"code", static_cast<int>(e.failure.code)},
            {"reason", e.failure.reason},
            {"window", e.failure.window}};
  }
  Json operator()(const announce::Done&) const { return {{"event", "done"}}; }
};

std::string line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string event_line(const Announcement& what) {
  return line(std::visit(ToJson{}, what));
}

std::string listening_line(const std::string& endpoint) {
  return line({{"event", "listening"}, {"endpoint", endpoint}, {"pid", getpid()}});
}

}  // namespace standoff
