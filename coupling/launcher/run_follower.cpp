#include "coupling/launcher/run_follower.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <signal.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/text_format.hpp"

namespace standoff::launch {
namespace {

namespace files = std::filesystem;
constexpr double silence_limit =
    15.0;  // s without a line; a run writes one every second, its start and end take longer

bool alive(long pid) {
  return kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM;
}

double seconds_since_write(const std::string& path) {
  std::error_code error;
  const auto when = files::last_write_time(path, error);
  return error ? 1e9 : std::chrono::duration<double>(files::file_time_type::clock::now() - when).count();
}

}  // namespace

OrderedJson read_record(const std::string& folder) {
  std::ifstream file(folder + "/run.json");
  if (!file)
    throw Stop(ExitCode::bad_case, fmt::format("{} is not a run folder: it has no run.json\n  a run folder is what "
                                               "`standoff run` writes, by default runs/CASE/LEVEL-NUMBER",
                                               folder));
  OrderedJson record = OrderedJson::parse(file, nullptr, false);
  if (!record.is_object() || !record.contains("status") || !record["status"].is_string())
    throw Stop(ExitCode::bad_case, fmt::format("{}/run.json cannot be read: it is not the record of a run", folder));
  return record;
}

RunFollower::RunFollower(std::string folder) : folder_(std::move(folder)), record_(read_record(folder_)) {
  catch_up();
}

void RunFollower::catch_up() {
  // The record first: when it says that the run has ended, the log that is read afterwards is complete.
  record_ = read_record(folder_);
  if (!log_.is_open()) log_.open(folder_ + "/log.jsonl");
  log_.clear();
  for (std::string piece; std::getline(log_, piece);) {
    partial_ += piece;
    if (log_.eof()) break;  // the end of this line is not written yet
    take(partial_);
    partial_.clear();
  }
}

void RunFollower::take(const std::string& line) {
  const auto j = nlohmann::json::parse(line, nullptr, false);
  if (j.is_object() && j.contains("wall_s") && j["wall_s"].is_number()) wall_s_ = j["wall_s"];
  const auto event = parse_event(line);
  if (!event) return;
  if (const auto* joined = std::get_if<JoinedEvent>(&*event)) {
    pids_.push_back(joined->pid);
    notes_.push_back(fmt::format("{} joined (process {})", joined->name, joined->pid));
  } else if (const auto* clock = std::get_if<ClockEvent>(&*event)) {
    progress_.take(*clock);
  } else if (const auto* progress = std::get_if<ProgressEvent>(&*event)) {
    progress_.take(*progress);
  } else if (const auto* waiting = std::get_if<WaitingEvent>(&*event)) {
    std::string names;
    for (const std::string& name : waiting->names) names += (names.empty() ? "" : ", ") + name;
    notes_.push_back(fmt::format("waiting for {} since {:.0f} s", names, waiting->since_s));
  } else if (const auto* failed = std::get_if<FailedEvent>(&*event)) {
    notes_.push_back(fmt::format("failed: {}: {}", failed->origin, failed->reason));
  }
}

std::vector<std::string> RunFollower::take_notes() {
  return std::exchange(notes_, {});
}

bool RunFollower::silent() const {
  return seconds_since_write(folder_ + "/log.jsonl") > silence_limit &&
         seconds_since_write(folder_ + "/run.json") > silence_limit;
}

std::string RunFollower::status() const {
  const std::string status = record_["status"];
  if (status != "running") return status;
  return silent() && std::none_of(pids_.begin(), pids_.end(), alive) ? "abandoned" : status;
}

OrderedJson snapshot_json(const RunFollower& run) {
  const OrderedJson& record = run.record();
  OrderedJson j{{"status", run.status()}};
  for (const char* key : {"exit_code", "reason", "case", "level", "seed", "structure_model"})
    j[key] = record.contains(key) ? record[key] : OrderedJson(nullptr);
  j["wall_s"] = run.status() == "running" ? run.wall_s() : number_at(record, "timing.wall_s").value_or(run.wall_s());
  j["progress"] = progress_json(run.progress());
  j["progress"].erase("event");
  for (const char* key : {"results", "conservation", "relaxation"})
    if (record.contains(key)) j[key] = record[key];
  return j;
}

std::string snapshot_text(const std::string& folder, const RunFollower& run) {
  const OrderedJson& record = run.record();
  const std::string status = run.status(), level = record.value("level", "");
  std::string text = fmt::format("{}: {}\n", folder, status);
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"case", fmt::format("{}{}{}, seed {}", record.value("case", "?"), level.empty() ? "" : ", level ",
                                      level, record.contains("seed") ? record["seed"].dump() : "?")});
  if (const std::string reason = record.value("reason", ""); !reason.empty()) rows.push_back({"reason", reason});
  if (record.contains("exit_code") && record["exit_code"].is_number())
    rows.push_back({"exit code", record["exit_code"].dump()});
  if (status == "abandoned")
    rows.push_back({"note", "its processes are gone without a word; log.txt tells how far it came"});
  if (status != "done") rows.push_back({"reached", when_text(run.progress())});
  const double wall = status == "running" ? run.wall_s() : number_at(record, "timing.wall_s").value_or(run.wall_s());
  rows.push_back({"wall clock", wall_text(wall)});
  const auto impulse = number_at(record, "results.impulse_Ns");
  const double latest = impulse.value_or(run.progress().impulse_Ns);
  if (std::isfinite(latest)) rows.push_back({"impulse", value_text("impulse_Ns", latest)});
  if (const auto w = number_at(record, "results.permanent_centre_deflection_m"))
    rows.push_back({"permanent centre deflection", value_text("deflection_m", *w)});
  for (const char* key : {"energy_error_particles", "energy_error_structure", "interface_work_error"})
    if (const auto error = number_at(record, std::string("conservation.") + key))
      rows.push_back({label_of(key), fmt::format("{:.2g} %", 100.0 * *error)});
  if (!record.contains("conservation") && std::isfinite(run.progress().energy_error))
    rows.push_back({"energy error", fmt::format("{:.2g} %", 100.0 * run.progress().energy_error)});
  return text + table_text(rows, {false, false});
}

}  // namespace standoff::launch
