#include <cstdio>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/run_follower.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

int status_verb(const FolderOptions& options) {
  const RunFollower run(options.folder);
  if (options.json)
    std::printf("%s\n", snapshot_json(run).dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  else
    std::fputs(snapshot_text(options.folder, run).c_str(), stdout);
  return static_cast<int>(ExitCode::done);
}

}  // namespace standoff::launch
