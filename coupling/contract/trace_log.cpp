#include "coupling/contract/trace_log.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

namespace standoff {
namespace {

std::string slice(const std::string& name, const char* category, long pid, double begin, double length) {
  return fmt::format(
      "{{\"name\":\"{}\",\"cat\":\"{}\",\"ph\":\"X\",\"pid\":{},\"tid\":{},\"ts\":{:.3f},\"dur\":{:.3f}}}\n", name,
      category, pid, pid, begin, std::max(length, 0.0));
}

}  // namespace

double TraceLog::now() {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void TraceLog::begin(const StageTimers* stages) {
  if (stages == nullptr) return;
  before_.clear();
  for (const StageTimers::Row& row : stages->rows()) before_.push_back(row.seconds);
}

void TraceLog::window(std::int64_t number, double wait, double begin, double end, const StageTimers* stages) {
  Window window{number, wait, begin, end, {}};
  if (stages != nullptr) {
    before_.resize(stages->rows().size());
    names_.resize(before_.size());
    for (std::size_t i = 0; i < before_.size(); ++i) {
      window.stages.push_back(1e6 * (stages->rows()[i].seconds - before_[i]));
      before_[i] = stages->rows()[i].seconds;
      names_[i] = stages->rows()[i].name;
    }
  }
  if (number % stride_ == 0) windows_.push_back(std::move(window));
  if (windows_.size() <= most_) return;
  stride_ *= 2;
  std::erase_if(windows_, [&](const Window& w) { return w.number % stride_ != 0; });
}

std::string TraceLog::lines(const std::string& name, long pid) const {
  std::string text =
      fmt::format("{{\"name\":\"process_name\",\"ph\":\"M\",\"pid\":{},\"args\":{{\"name\":\"{}\"}}}}\n", pid, name);
  for (const Window& w : windows_) {
    if (w.wait > 0.0) text += slice("wait", "wait", pid, w.begin - w.wait, w.wait);
    text += slice(fmt::format("window {}", w.number), "compute", pid, w.begin, w.end - w.begin);
    double at = w.begin;
    for (std::size_t i = 0; i < w.stages.size(); ++i) {
      // A clock read twice must not push the last stage out of its window.
      const double length = std::min(w.stages[i], w.end - at);
      if (length > 0.0) text += slice(names_[i], "stage", pid, at, length), at += length;
    }
  }
  return text;
}

}  // namespace standoff
