#include "coupling/launcher/child_process.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "coupling/base/stop.hpp"

namespace standoff::launch {
namespace {

constexpr std::size_t longest_line = std::size_t{64} << 20;  // a report is one line; what is longer is cut, not kept

struct Pipe {
  int read = -1, write = -1;
};

Pipe make_pipe() {
  std::array<int, 2> fds{};
  if (pipe2(fds.data(), O_CLOEXEC) != 0)
    throw Stop(ExitCode::out_of_resources, fmt::format("cannot open a pipe: {}", strerror(errno)));
  return {fds[0], fds[1]};
}

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& added) {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!added.contains(text.substr(0, text.find('=')))) entries.push_back(text);
  }
  for (const auto& [name, value] : added) entries.push_back(name + "=" + value);
  return entries;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

struct ChildEnds {
  int out, err, failure;
  pid_t launcher;
  int death_signal;
};

/// Between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* argv, char* const* environment, const ChildEnds& ends) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, ends.death_signal);
  if (getppid() != ends.launcher) _exit(127);  // the launcher died before the line above took effect
  sigset_t none;
  sigemptyset(&none);
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ, SIGCHLD}) ::signal(number, SIG_DFL);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(null, 0), dup2(ends.out, 1), dup2(ends.err, 2);
  execve(argv[0], argv, environment);
  const int error = errno;
  [[maybe_unused]] const auto written = write(ends.failure, &error, sizeof error);
  _exit(127);
}

void keep_from_blocking(int fd) {
  fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK);
}

}  // namespace

void LineReader::read_some(const std::function<void(const std::string&)>& take) {
  std::array<char, 65536> buffer;
  while (fd_ >= 0) {
    const ssize_t count = read(fd_, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EAGAIN) return;
    if (count <= 0) {
      if (!rest_.empty()) take(rest_);
      return close();
    }
    rest_.append(buffer.data(), static_cast<std::size_t>(count));
    std::size_t begin = 0;
    for (std::size_t end; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1)
      take(rest_.substr(begin, end - begin));
    rest_.erase(0, begin);
    if (rest_.size() > longest_line) rest_.clear();
  }
}

void LineReader::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
  rest_.clear();
}

void ChildProcess::signal(int number) const {
  if (pid > 0) kill(-pid, number);
}

ChildProcess start_child(const ChildCommand& command) {
  std::vector<std::string> arguments = command.argv;
  std::vector<std::string> environment = merged_environment(command.environment);
  const std::vector<char*> argv = pointers(arguments), envp = pointers(environment);
  const Pipe out = make_pipe(), err = make_pipe(), failure = make_pipe();
  const pid_t launcher = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(argv.data(), envp.data(), {out.write, err.write, failure.write, launcher, command.death_signal});
  ::close(out.write), ::close(err.write), ::close(failure.write);
  if (pid < 0)
    throw Stop(ExitCode::out_of_resources, fmt::format("cannot start {}: {}", command.name, strerror(errno)));
  setpgid(pid, pid);  // on both sides: whoever is first
  int error = 0;
  const bool failed = read(failure.read, &error, sizeof error) == sizeof error;
  ::close(failure.read);
  keep_from_blocking(out.read), keep_from_blocking(err.read);
  if (failed)
    throw Stop(ExitCode::participant_lost,
               fmt::format("cannot start {} ({}): {}", command.name, arguments[0], strerror(error)));
  return {command.name, pid, LineReader(out.read), LineReader(err.read), true, 0, 0.0, {}};
}

std::string program_folder() {
  if (const char* folder = std::getenv("STANDOFF_BIN_DIR"); folder != nullptr && *folder != '\0') return folder;
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

std::string program_path(const std::string& name) {
  const std::string path = program_folder() + "/" + name;
  if (access(path.c_str(), X_OK) != 0)
    throw Stop(
        ExitCode::participant_lost,
        fmt::format("{} is missing: all programs of Standoff lie in one folder; build or install them together", path));
  return path;
}

}  // namespace standoff::launch
