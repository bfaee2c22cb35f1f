#include "coupling/launcher/run_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include "coupling/base/stop.hpp"

namespace standoff::launch {
namespace {

[[noreturn]] void give_up(const std::string& path) {
  throw Stop(ExitCode::out_of_resources, fmt::format("cannot write {}: {}", path, strerror(errno)));
}

}  // namespace

GrowingFile::GrowingFile(const std::string& path, bool append)
    : path_(path), fd_(open(path.c_str(), O_WRONLY | O_CREAT | (append ? O_APPEND : O_TRUNC) | O_CLOEXEC, 0666)) {
  if (fd_ < 0) give_up(path_);
}

GrowingFile::~GrowingFile() {
  if (fd_ >= 0) close(fd_);
}

void GrowingFile::append(const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(fd_, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) give_up(path_);
    done += static_cast<std::size_t>(count);
  }
}

RunLog::RunLog(const std::string& folder, double earlier)
    : begin_(std::chrono::steady_clock::now()),
      earlier_(earlier),
      text_(folder + "/log.txt", earlier > 0.0),
      json_(folder + "/log.jsonl", earlier > 0.0) {}

double RunLog::seconds() const {
  return earlier_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void RunLog::line(const std::string& who, const std::string& text) {
  event(who, text, {{"event", "line"}, {"text", text}});
}

void RunLog::event(const std::string& who, const std::string& text, nlohmann::json object) {
  const double now = seconds();
  if (!text.empty()) text_.append(fmt::format("{:10.3f} s  {:<10}  {}\n", now, who, text));
  object["wall_s"] = now;
  object["who"] = who;
  json_.append(object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace standoff::launch
