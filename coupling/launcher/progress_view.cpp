#include "coupling/launcher/progress_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "coupling/launcher/text_format.hpp"

namespace standoff::launch {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double pace_memory = 10.0;     // s
constexpr double terminal_period = 0.2;  // s between rewrites
constexpr double plain_period = 5.0;     // s between plain lines
constexpr double json_period = 1.0;

void set_if_there(double& target, const Values& values, const char* name) {
  if (const auto at = values.find(name); at != values.end()) target = at->second;
}

/// Two times in the unit that suits the larger: "0.412/2.000 ms".
std::string time_pair(double now, double end, const char* between) {
  const bool milli = end < 1.0;
  const double factor = milli ? 1e3 : 1.0;
  return fmt::format("{:.3f}{}{:.3f} {}", now * factor, between, end * factor, milli ? "ms" : "s");
}

double period_of(ViewMode mode) {
  return mode == ViewMode::terminal ? terminal_period : mode == ViewMode::json ? json_period : plain_period;
}

std::string relaxation_line(const RunProgress& p) {
  std::string line = fmt::format("coming to rest  t +{:.2f} ms", p.relax_time_s * 1e3);
  if (std::isfinite(p.kinetic_ratio)) line += fmt::format("  kinetic energy {:.1e} of its peak", p.kinetic_ratio);
  if (std::isfinite(p.centre_deflection_m)) line += fmt::format("  centre {:.2f} mm", p.centre_deflection_m * 1e3);
  return line;
}

}  // namespace

RunProgress::RunProgress()
    : step_s(unknown),
      impulse_Ns(unknown),
      energy_error(unknown),
      relax_time_s(unknown),
      kinetic_ratio(unknown),
      centre_deflection_m(unknown),
      eta_s(unknown) {}

void RunProgress::take(const ClockEvent& event) {
  windows = event.windows;
  until_s = event.window_s * static_cast<double>(event.windows);
}

void RunProgress::take(const ProgressEvent& event) {
  const Values& values = event.values;
  if (values.contains("relax_time_s")) {
    relaxing = true;
    set_if_there(relax_time_s, values, "relax_time_s");
    set_if_there(kinetic_ratio, values, "kinetic_ratio");
    set_if_there(centre_deflection_m, values, "centre_deflection_m");
    return;
  }
  if (!values.contains("window")) return;
  window = static_cast<long>(values.at("window"));
  set_if_there(time_s, values, "time_s");
  set_if_there(step_s, values, "step_s");
  set_if_there(impulse_Ns, values, "impulse_Ns");
  set_if_there(energy_error, values, "energy_error");
  for (const auto& [name, value] : values)
    if (name.starts_with("limited_by:") && value > 0.0) limited_by = name.substr(11);
}

std::string progress_line(const RunProgress& p) {
  if (p.relaxing) return relaxation_line(p);
  if (p.windows <= 0) return "starting";
  std::string line = fmt::format("t {}  {:.0f} %  window {}/{}", time_pair(p.time_s, p.until_s, "/"),
                                 100.0 * p.time_s / std::max(p.until_s, 1e-300), with_separators(p.window),
                                 with_separators(p.windows));
  if (std::isfinite(p.step_s)) line += "  dt " + duration_text(p.step_s);
  if (!p.limited_by.empty()) line += " (limited by " + p.limited_by + ")";
  if (std::isfinite(p.impulse_Ns)) line += fmt::format("  impulse {:.1f} N s", p.impulse_Ns);
  if (std::isfinite(p.energy_error)) line += fmt::format("  energy error {:.2g} %", 100.0 * p.energy_error);
  return line + "  ETA " + clock_text(p.eta_s);
}

nlohmann::json progress_json(const RunProgress& p) {
  nlohmann::json j{{"event", "progress"}, {"phase", p.relaxing ? "relax" : p.windows > 0 ? "load" : "start"}};
  const std::pair<const char*, double> numbers[] = {{"time_s", p.time_s},
                                                    {"until_s", p.until_s},
                                                    {"step_s", p.step_s},
                                                    {"impulse_Ns", p.impulse_Ns},
                                                    {"energy_error", p.energy_error},
                                                    {"relax_time_s", p.relax_time_s},
                                                    {"kinetic_ratio", p.kinetic_ratio},
                                                    {"centre_deflection_m", p.centre_deflection_m},
                                                    {"eta_s", p.eta_s}};
  for (const auto& [name, value] : numbers)
    if (std::isfinite(value)) j[name] = value;
  j["window"] = p.window, j["windows"] = p.windows;
  if (!p.limited_by.empty()) j["limited_by"] = p.limited_by;
  return j;
}

std::string when_text(const RunProgress& p) {
  if (p.relaxing) return fmt::format("while coming to rest, {:.2f} ms after the loading", p.relax_time_s * 1e3);
  if (p.windows <= 0) return "before the first window";
  return fmt::format("t {}, window {} of {}", time_pair(p.time_s, p.until_s, " of "), with_separators(p.window),
                     with_separators(p.windows));
}

void PaceMeter::add(double wall_s, long window) {
  if (!recent_.empty() && recent_.back().second == window) return;
  recent_.emplace_back(wall_s, window);
  while (recent_.size() > 2 && wall_s - recent_.front().first > pace_memory) recent_.pop_front();
}

double PaceMeter::remaining(long windows) const {
  if (recent_.size() < 2) return unknown;
  const auto& [begin, first] = recent_.front();
  const auto& [now, last] = recent_.back();
  return static_cast<double>(windows - last) * (now - begin) / static_cast<double>(std::max(1L, last - first));
}

ViewMode view_mode(bool quiet, bool json) {
  if (quiet) return ViewMode::quiet;
  if (json) return ViewMode::json;
  return isatty(STDOUT_FILENO) != 0 ? ViewMode::terminal : ViewMode::plain;
}

void ProgressView::show(double wall_s) {
  if (mode_ == ViewMode::quiet) return;
  pace_.add(wall_s, progress_.window);
  progress_.eta_s = pace_.remaining(progress_.windows);
  if (wall_s - last_shown_ < period_of(mode_)) return;
  std::string text = mode_ == ViewMode::json ? progress_json(progress_).dump() : progress_line(progress_);
  if (text == last_text_) return;
  last_text_ = text;
  last_shown_ = wall_s;
  if (mode_ != ViewMode::terminal) {
    std::printf("%s\n", text.c_str());
  } else {
    winsize size{};
    ioctl(STDOUT_FILENO, TIOCGWINSZ, &size);
    if (size.ws_col > 1 && text.size() >= size.ws_col) text.resize(size.ws_col - 1u);
    std::printf("\r\033[K%s", text.c_str());
    line_open_ = true;
  }
  std::fflush(stdout);
}

void ProgressView::note(const std::string& text) {
  if (mode_ == ViewMode::quiet) return;
  end_line();
  if (mode_ == ViewMode::json)
    std::printf("%s\n", nlohmann::json{{"event", "note"}, {"text", text}}.dump().c_str());
  else
    std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

void ProgressView::end_line() {
  if (line_open_) std::printf("\n");
  line_open_ = false;
  std::fflush(stdout);
}

}  // namespace standoff::launch
