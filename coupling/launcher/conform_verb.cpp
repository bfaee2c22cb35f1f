#include <string>

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

int conform_verb(char** arguments) {
  std::string program = program_path("standoff-conform");
  std::vector<char*> argv{program.data()};
  for (; *arguments != nullptr; ++arguments) argv.push_back(*arguments);
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  throw Stop(ExitCode::participant_lost, "cannot start " + program + ": " + strerror(errno));
}

}  // namespace standoff::launch
