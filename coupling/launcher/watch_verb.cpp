#include <chrono>
#include <cstdio>
#include <thread>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/run_follower.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {
namespace {

constexpr auto look_period = std::chrono::milliseconds(250);

/// Exit code of the run itself, so that a script can wait for a run and go on only if it went well.
int exit_code_of(const RunFollower& run) {
  const auto code = number_at(run.record(), "exit_code");
  return code ? static_cast<int>(*code) : static_cast<int>(ExitCode::participant_lost);
}

}  // namespace

int watch_verb(const FolderOptions& options) {
  RunFollower run(options.folder);
  ProgressView view(view_mode(false, options.json));
  while (true) {
    for (const std::string& note : run.take_notes()) view.note(note);
    view.progress() = run.progress();
    if (run.status() != "running") break;
    view.show(run.wall_s());
    std::this_thread::sleep_for(look_period);
    run.catch_up();
  }
  view.end_line();
  if (options.json)
    std::printf("%s\n", OrderedJson{{"event", "end"}, {"run", snapshot_json(run)}}
                            .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                            .c_str());
  else
    std::fputs(snapshot_text(options.folder, run).c_str(), stdout);
  return exit_code_of(run);
}

}  // namespace standoff::launch
