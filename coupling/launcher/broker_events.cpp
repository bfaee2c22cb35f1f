#include "coupling/launcher/broker_events.hpp"

#include <limits>

namespace standoff::launch {
namespace {

using nlohmann::json;

/// JSON has no NaN: a number that is not one arrives as null.
double number(const json& j) {
  return j.is_number() ? j.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

Values values_of(const json& j) {
  Values values;
  if (j.contains("values"))
    for (const auto& [name, value] : j.at("values").items()) values[name] = number(value);
  return values;
}

/// Texts of a string, an array or an object {name: text}, joined for a reader.
std::string words(const json& j) {
  if (j.is_string()) return j.get<std::string>();
  std::string text;
  for (const auto& [key, value] : j.items()) {
    if (!text.empty()) text += ", ";
    if (j.is_object()) text += key + ": ";
    text += value.is_string() ? value.get<std::string>() : value.dump();
  }
  return text;
}

std::array<double, 3> vector_of(const json& j) {
  return {number(j.at(0)), number(j.at(1)), number(j.at(2))};
}

WaitingEvent waiting(const json& j) {
  WaitingEvent event;
  const json& names = j.at("for");
  if (names.is_string()) event.names = {names.get<std::string>()};
  if (names.is_array()) event.names = names.get<std::vector<std::string>>();
  event.since_s = number(j.at("since_s"));
  if (j.contains("stage")) event.stage = words(j.at("stage"));
  return event;
}

ReportEvent report(const json& j) {
  json content = j.at("report");
  if (content.is_string()) content = json::parse(content.get<std::string>());
  return {j.at("name"), content};
}

std::optional<BrokerEvent> event_of(const json& j) {
  const std::string kind = j.at("event");
  if (kind == "joined") return JoinedEvent{j.at("name"), j.value("role", ""), j.value("pid", 0L)};
  if (kind == "clock") return ClockEvent{number(j.at("window_s")), j.at("windows"), j.value("scheme", "")};
  if (kind == "waiting") return waiting(j);
  if (kind == "progress") return ProgressEvent{j.at("name"), values_of(j)};
  if (kind == "sample") return SampleEvent{j.at("name"), number(j.at("time_s")), values_of(j)};
  if (kind == "report") return report(j);
  if (kind == "interface")
    return InterfaceEvent{number(j.at("bytes")), vector_of(j.at("impulse_given_Ns")),
                          vector_of(j.at("impulse_received_Ns")), number(j.at("work_given_J")),
                          number(j.at("work_received_J"))};
  if (kind == "failed")
    return FailedEvent{j.value("origin", ""), j.value("code", 4), j.value("reason", ""), j.value("window", -1L)};
  if (kind == "saving") return SavingEvent{j.value("reason", "")};
  if (kind == "checkpoint") return CheckpointEvent{j.at("windows"), number(j.at("time_s")), number(j.at("bytes"))};
  if (kind == "done") return DoneEvent{};
  return std::nullopt;
}

}  // namespace

std::optional<BrokerEvent> parse_event(const std::string& line) {
  try {
    const json j = json::parse(line);
    if (!j.is_object() || !j.contains("event")) return std::nullopt;
    return event_of(j);
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace standoff::launch
