#include "coupling/transport/endpoint.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "coupling/base/stop.hpp"

namespace standoff {
namespace {

bool is_loopback(const std::string& address) {
  const std::string host = address.substr(0, address.rfind(':'));
  const bool numbers = host.find_first_not_of("0123456789.") == std::string::npos;
  return (numbers && host.starts_with("127.")) || host == "localhost" || host == "[::1]";
}

/// libzmq takes a port beyond 65535 modulo 65536.
bool is_port(const std::string& text) {
  if (text == "*") return true;
  return !text.empty() && text.size() <= 5 && text.find_first_not_of("0123456789") == std::string::npos &&
         std::stoi(text) >= 1 && std::stoi(text) <= 65535;
}

bool same_file(int file, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(file, &opened) == 0 && stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

Endpoint parse_endpoint(const std::string& text, bool allowed) {
  Endpoint endpoint;
  endpoint.text = text;
  endpoint.inproc = text.starts_with("inproc://") && text.size() > 9;
  if (endpoint.inproc) return endpoint;
  if (text.starts_with("ipc://")) {
    endpoint.path = text.substr(6);
    const std::size_t longest = sizeof(sockaddr_un::sun_path) - 1;
    if (endpoint.path.empty() || endpoint.path[0] != '/')
      throw Stop(ExitCode::bad_case,
                 fmt::format("endpoint \"{}\": an absolute path is needed, ipc:///folder/name", text));
    if (endpoint.path.size() > longest)
      throw Stop(ExitCode::bad_case,
                 fmt::format("endpoint \"{}\": its path has {} characters, the system allows {}; use "
                             "a shorter folder",
                             text, endpoint.path.size(), longest));
    return endpoint;
  }
  if (!text.starts_with("tcp://") || text.rfind(':') < 7 || !is_port(text.substr(text.rfind(':') + 1)))
    throw Stop(ExitCode::bad_case,
               fmt::format("endpoint \"{}\": expected ipc:///folder/name or tcp://127.0.0.1:port, port 1 .. 65535 or *",
                           text));
  endpoint.loopback = is_loopback(text.substr(6));
  if (!endpoint.loopback && !allowed)
    throw Stop(ExitCode::bad_case,
               fmt::format("endpoint \"{}\" can be reached from other machines and the connection is "
                           "not encrypted: use tcp://127.0.0.1:port, give keys (--curve-secret ...), or say "
                           "--insecure on a network you trust",
                           text));
  return endpoint;
}

std::string why_out_of_reach(const std::string& endpoint) {
  if (!endpoint.starts_with("inproc://")) return {};
  return fmt::format(
      "\"{}\" joins threads of one process, and here each participant is a process: use "
      "ipc:///folder/name or tcp://127.0.0.1:port",
      endpoint);
}

EndpointLock::EndpointLock(const Endpoint& endpoint) : path_(endpoint.path) {
  if (path_.empty()) return;
  const std::string lock = path_ + ".lock";
  for (;;) {
    file_ = open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (file_ < 0) throw Stop(ExitCode::bad_case, fmt::format("cannot create {}: {}", lock, std::strerror(errno)));
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      close(file_);
      file_ = -1;
      throw Stop(ExitCode::bad_case, fmt::format("another broker listens on {}: choose another path", endpoint.text));
    }
    if (same_file(file_, lock)) return;
    close(file_);  // its owner removed it between our open and our lock
  }
}

EndpointLock::~EndpointLock() {
  if (file_ < 0) return;
  unlink(path_.c_str());
  unlink((path_ + ".lock").c_str());
  close(file_);
}

}  // namespace standoff
