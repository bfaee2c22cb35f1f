#pragma once
// A stage for the launcher: a folder of its own with stand-ins for the three programs, a case, a runtime folder for
// sockets. Each stand-in plays what FAKE_BROKER, FAKE_PARTICLES or FAKE_STRUCTURE asks for:
//   done      (the broker first prints a whole run) and ends with status 0
//   hang      the run starts and then nothing happens; ends on SIGTERM
//   stubborn  the same, but deaf to SIGTERM and SIGINT
//   exit3     complains on its error output and ends with status 3
//   failed    broker: reports that the structure failed with code 3, then ends with status 4
//   flood     broker: history rows without end
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace standoff::launch {

namespace files = std::filesystem;

inline std::string read_file(const files::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

inline bool wait_until(const std::function<bool()>& condition, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds / 0.02); ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return condition();
}

class LauncherStage : public ::testing::Test {
 protected:
  LauncherStage() : root_(files::temp_directory_path() / ("launch_stage_" + std::to_string(getpid()))) {
    files::remove_all(root_);
    for (const char* folder : {"bin", "runtime", "pids"}) files::create_directories(root_ / folder);
    std::ofstream(root_ / "events") << events;
    std::ofstream(root_ / "case.toml") << case_text;
    for (const char* name : {"broker", "particles", "structure"}) {
      const files::path program = root_ / "bin" / (std::string("standoff-") + name);
      files::copy_file(STANDOFF_SOURCE_DIR "/tests/contract/launch_stand_in.sh", program);
      files::permissions(program, files::perms::owner_all);
    }
  }
  ~LauncherStage() override {
    if (launcher_ > 0) kill(launcher_, SIGKILL), waitpid(launcher_, nullptr, 0);
    for (const auto& [name, pid] : stand_ins()) kill(pid, SIGKILL);
    files::remove_all(root_);
  }

  /// Starts `standoff` with `arguments` in the stage's folder. file_limit: largest file it may write, 0 = any.
  void start(std::vector<std::string> arguments, const std::map<std::string, std::string>& plays = {},
             rlim_t file_limit = 0) {
    launcher_ = fork();
    if (launcher_ != 0) return;
    for (const auto& [name, value] : plays) setenv(name.c_str(), value.c_str(), 1);
    if (!real_programs_) setenv("STANDOFF_BIN_DIR", (root_ / "bin").c_str(), 1);
    setenv("XDG_RUNTIME_DIR", (root_ / "runtime").c_str(), 1);
    setenv("FAKE_STAGE", root_.c_str(), 1);
    if (file_limit > 0) {
      const rlimit limit{file_limit, file_limit};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (chdir(root_.c_str()) != 0) _exit(99);
    dup2(open("out.txt", O_WRONLY | O_CREAT | O_APPEND, 0666), 1);
    dup2(open("err.txt", O_WRONLY | O_CREAT | O_APPEND, 0666), 2);
    arguments.insert(arguments.begin(), STANDOFF_BIN_DIR "/standoff");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(98);
  }

  /// Exit code of the launcher; -1 if it has not ended after 10 s, the contract's limit from the first failure on.
  int finish(double seconds = 10.0) {
    int status = 0;
    const bool ended = wait_until([&] { return waitpid(launcher_, &status, WNOHANG) == launcher_; }, seconds);
    if (!ended) return -1;
    launcher_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  int run(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& plays = {}) {
    start(arguments, plays);
    return finish();
  }

  std::map<std::string, pid_t> stand_ins() const {
    std::map<std::string, pid_t> found;
    for (const auto& entry : files::directory_iterator(root_ / "pids"))
      if (const std::string text = read_file(entry.path()); !text.empty())
        found[entry.path().filename()] = std::stoi(text);
    return found;
  }
  /// All three play, with what they started.
  bool all_playing() const { return stand_ins().size() == 6; }
  bool anyone_left() const {
    for (const auto& [name, pid] : stand_ins())
      if (kill(pid, 0) == 0) return true;
    return false;
  }
  bool sockets_left() const { return !files::is_empty(root_ / "runtime"); }
  void expect_clean() const {
    EXPECT_FALSE(anyone_left()) << "a process outlived the launcher";
    EXPECT_FALSE(sockets_left()) << "a folder of sockets was left";
  }
  nlohmann::json record() const { return nlohmann::json::parse(read_file(root_ / "run/run.json"), nullptr, false); }
  std::string errors() const { return read_file(root_ / "err.txt"); }
  std::string output() const { return read_file(root_ / "out.txt"); }

  files::path root_;
  pid_t launcher_ = -1;
  bool real_programs_ = false;  // true: no stand-ins

 private:
  static constexpr const char* case_text = R"([case]
name = "stage"
title = "a small scene for stand-ins"
level = "coarse"
[charge]
explosive = "c4"
mass = "150 g"
radius = "28.2 mm"
[plate]
material = "al6xn"
size = ["406 mm", "406 mm", "3.4 mm"]
elements = [2, 2, 1]
[run]
stand_off = "150 mm"
until = "1 ms"
[levels.coarse]
charge = 100
)";
  static constexpr const char* events =
      R"({"event":"joined","name":"structure","role":"structure","pid":1}
{"event":"clock","window_s":1e-6,"windows":1000,"scheme":"parallel"}
{"event":"progress","name":"particles","values":{"time_s":4e-4,"window":400,"windows":1000,"step_s":3e-8}}
{"event":"sample","name":"particles","time_s":0,"values":{"impulse_Ns":0,"work_to_structure_J":0}}
{"event":"sample","name":"structure","time_s":0,"values":{"centre_deflection_m":0,"external_work_J":0}}
{"event":"sample","name":"structure","time_s":5e-6,"values":{"centre_deflection_m":0.001,"external_work_J":100}}
{"event":"sample","name":"particles","time_s":5e-6,"values":{"impulse_Ns":130,"work_to_structure_J":101}}
{"event":"report","name":"particles","report":{"results":{"impulse_Ns":130.0},"provenance":{"state_hash":"aa"}}}
{"event":"report","name":"structure","report":{"results":{"permanent_centre_deflection_m":0.02},"relaxation":{"at_rest":true},"provenance":{"state_hash":"bb"}}}
{"event":"interface","bytes":1000,"impulse_given_Ns":[0,0,-32],"impulse_received_Ns":[0,0,-32],"work_given_J":25.25,"work_received_J":25}
{"event":"done"}
)";
};

}  // namespace standoff::launch
