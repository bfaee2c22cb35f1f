#include "coupling/launcher/private_folder.hpp"

#include <array>
#include <cstdlib>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "coupling/base/stop.hpp"

namespace standoff::launch {
namespace {

constexpr std::size_t longest_base = 60;  // leaves room for /standoff-XXXXXX/broker below 107 characters

/// XDG_RUNTIME_DIR if it is a usable folder of ours, else /tmp.
std::string base_folder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  struct stat facts {};
  const bool usable = runtime != nullptr && *runtime == '/' && strlen(runtime) <= longest_base &&
                      stat(runtime, &facts) == 0 && S_ISDIR(facts.st_mode) && facts.st_uid == geteuid() &&
                      access(runtime, W_OK | X_OK) == 0;
  return usable ? runtime : "/tmp";
}

std::string make_folder() {
  std::string pattern = base_folder() + "/standoff-XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr)
    throw Stop(ExitCode::out_of_resources, fmt::format("cannot create {}: {}", pattern, strerror(errno)));
  return pattern;
}

/// Waits for the other end of the pipe to close, removes the folder, ends.
[[noreturn]] void guard(int pipe_end, const std::string& folder) {
  setpgid(0, 0);
  prctl(PR_SET_NAME, "standoff-guard");
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) signal(number, SIG_IGN);
  if (pipe_end != 3) dup2(pipe_end, 3);
  close_range(4, ~0u, 0);
  for (int fd = 0; fd < 3; ++fd) close(fd);  // holds no pipe or terminal of the caller open
  char byte = 0;
  while (read(3, &byte, 1) < 0 && errno == EINTR) continue;
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  _exit(0);
}

}  // namespace

PrivateFolder::PrivateFolder() : path_(make_folder()) {
  std::array<int, 2> fds{};
  if (pipe2(fds.data(), O_CLOEXEC) != 0) return;
  guard_ = fork();
  if (guard_ == 0) {
    close(fds[1]);
    guard(fds[0], path_);
  }
  close(fds[0]);
  life_ = fds[1];
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  if (life_ >= 0) close(life_);
  if (guard_ > 0) waitpid(guard_, nullptr, 0);
}

std::string run_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Stop(ExitCode::out_of_resources, "the system gives no random numbers for the run token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

}  // namespace standoff::launch
