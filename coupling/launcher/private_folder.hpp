#pragma once
// Where a run's sockets live: a new folder of mode 0700 on a local file system with a short path (a socket's path may
// have 107 characters), gone when the run ends in whatever way. A small guard process waits on a pipe for the
// launcher's end, so that even a launcher killed by signal 9 leaves no folder.
#include <string>

#include <sys/types.h>

namespace standoff::launch {

class PrivateFolder {
 public:
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  pid_t guard_ = -1;
  int life_ = -1;  // write end of the guard's pipe
};

/// 128 random bits from the kernel as 32 hexadecimal digits: who does not know them cannot join the run.
std::string run_token();

}  // namespace standoff::launch
