#pragma once
// A broker and participants as real processes (forked before any thread exists in the test), in a private folder.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "coupling/broker/broker.hpp"
#include "coupling/contract/participant_main.hpp"
#include "coupling/contract/process_watch.hpp"

namespace standoff::test {

/// Polls until `ready` or `seconds` have passed; true if it became ready. Tests wait for facts, never for a time.
inline bool eventually(double seconds, const std::function<bool()>& ready) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!ready()) {
    if (std::chrono::steady_clock::now() > until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

inline std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class Child {
 public:
  Child(const std::string& error_file, const std::function<int()>& body) : pid_(fork()) {
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (std::freopen(error_file.c_str(), "w", stderr) == nullptr) _exit(98);
    std::setvbuf(stderr, nullptr, _IONBF, 0);
    int code = 97;
    try {
      code = body();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    std::exit(code);
  }
  Child(Child&& from) noexcept : pid_(std::exchange(from.pid_, 0)), code_(from.code_) {}
  ~Child() {
    if (pid_ > 0 && !code_) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
  }
  void signal(int number) const { kill(pid_, number); }
  pid_t pid() const { return pid_; }
  /// Exit code, 128 + signal, or nothing if it still runs after `seconds`.
  std::optional<int> wait(double seconds = 10.0) {
    eventually(seconds, [&] {
      int status = 0;
      if (!code_ && waitpid(pid_, &status, WNOHANG) == pid_)
        code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      return code_.has_value();
    });
    return code_;
  }

 private:
  pid_t pid_;
  std::optional<int> code_;
};

class CoupledRun {
 public:
  CoupledRun() {
    char name[] = "/tmp/standoff-test-XXXXXX";
    folder = mkdtemp(name);
    broker.listen = "ipc://" + folder + "/broker";
    broker.rules.token = "c0ffee";
    broker.rules.until = 1.0;
    broker.rules.window = {WindowRule::Kind::fixed, 0.005};
  }
  ~CoupledRun() { std::filesystem::remove_all(folder); }
  CoupledRun(const CoupledRun&) = delete;

  Child start_broker() {
    Child child(error_file("broker"), [this] {
      std::ofstream events(folder + "/events");
      broker.print = [&](const std::string& line) { events << line << std::endl; };
      return participant_main("standoff-broker", [&] {
        if (const int code = run_broker(broker)) throw Stop(static_cast<ExitCode>(code), "ended");
      });
    });
    eventually(10.0, [&] { return !events("listening").empty(); });
    return child;
  }
  ParticipantOptions options(Role role) const {
    ParticipantOptions given{
        role == Role::load ? "particles" : "structure", role, "", broker.rules.token, "case", "test"};
    const auto listening = events("listening");
    given.endpoint = listening.empty() ? broker.listen : listening[0]["endpoint"].get<std::string>();
    given.join_deadline = 10.0;
    return given;
  }
  Child start(const ParticipantOptions& given, const std::function<void(Participant&)>& body) {
    return Child(error_file(given.name),
                 [&] { return participant_main("standoff-" + given.name, [&] { with_link(given, body); }); });
  }
  std::string error_file(const std::string& name) const { return folder + "/" + name + ".err"; }
  std::string errors(const std::string& name) const { return text_of(error_file(name)); }
  /// Everything from "first cause" on, as this process printed it.
  std::string cause(const std::string& name) const {
    const std::string text = errors(name);
    const auto at = text.find("first cause"), end = text.find('\n', at);
    return at == std::string::npos ? "nothing: " + text : text.substr(at, end - at);
  }
  std::vector<nlohmann::json> events(const std::string& kind) const {
    std::vector<nlohmann::json> found;
    std::ifstream lines(folder + "/events");
    for (std::string line; std::getline(lines, line);)
      if (const auto json = nlohmann::json::parse(line, nullptr, false); !json.is_discarded() && json["event"] == kind)
        found.push_back(json);
    return found;
  }

  std::string folder;
  BrokerOptions broker;
};

/// A strip of n quads.
inline SurfaceMesh strip(int n) {
  SurfaceMesh mesh;
  for (int i = 0; i <= n; ++i)
    for (const double y : {0.0, 0.1}) mesh.position.push_back({0.1 * i, y, 0.0});
  for (int i = 0; i < n; ++i) mesh.quads.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  mesh.node_mass.assign(mesh.position.size(), 0.01);
  return mesh;
}

/// Participants that follow the windows and do nothing else; `each` is called in every window.
inline void idle_structure(
    Participant& link, const std::function<void(std::int64_t)>& each = [](std::int64_t) {}) {
  const SurfaceMesh mesh = strip(3);
  link.offer_surface(mesh);
  link.ready({0.005, 0.0});
  while (const auto grant = link.next()) {
    each(grant->window);
    link.advance(SurfaceMotion{mesh.position, mesh.position}, {});
  }
  link.finish("{}");
}
inline void idle_load(
    Participant& link, const std::function<void(std::int64_t)>& each = [](std::int64_t) {}) {
  const SurfaceMesh mesh = link.receive_surface();
  link.ready({0.001, 0.0});
  while (const auto grant = link.next()) {
    each(grant->window);
    link.advance(SurfaceLoad{mesh.position}, {});
  }
  link.finish("{}");
}

}  // namespace standoff::test
