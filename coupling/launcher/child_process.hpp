#pragma once
// Starting one process so that it cannot outlive the launcher: its own process group (the terminal's Ctrl-C goes to the
// launcher alone), a death signal tied to the launcher's life, its outputs through pipes.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

namespace standoff::launch {

struct ChildCommand {
  std::string name;  // as messages call it
  std::vector<std::string> argv;
  std::map<std::string, std::string> environment;  // added to ours
  int death_signal = 9;                            // sent to it by the kernel when the launcher dies
};

/// Bytes of a pipe, cut into lines.
class LineReader {
 public:
  explicit LineReader(int fd = -1) : fd_(fd) {}
  int fd() const { return fd_; }
  bool open() const { return fd_ >= 0; }
  /// Reads what is there without waiting; calls `take` for each complete line, at the end for the rest.
  void read_some(const std::function<void(const std::string&)>& take);
  void close();

 private:
  int fd_;
  std::string rest_;
};

struct ChildProcess {
  std::string name;
  pid_t pid = -1;
  LineReader out, err;
  bool alive = false;
  long peak_bytes = 0;                  // largest resident memory, known at its end
  double cpu_s = 0.0;                   // processor time, likewise
  std::vector<std::string> last_lines;  // of its error output, newest last

  /// To the whole process group; quiet if it is gone.
  void signal(int number) const;
};

/// Throws Stop(participant_lost) if the program cannot be started.
ChildProcess start_child(const ChildCommand& command);

/// Folder of the program files: the one this program lies in, or STANDOFF_BIN_DIR where that is set (tests use it to
/// put stand-ins in place of the participants).
std::string program_folder();
/// Full path of a program of ours; throws Stop(participant_lost) if it is not there.
std::string program_path(const std::string& name);

}  // namespace standoff::launch
