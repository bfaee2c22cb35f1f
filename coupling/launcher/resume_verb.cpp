#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/build_facts.hpp"
#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/run_follower.hpp"
#include "coupling/launcher/run_session.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {
namespace {

namespace files = std::filesystem;

[[noreturn]] void incompatible(const std::string& reason) {
  throw Stop(ExitCode::checkpoint_incompatible, reason);
}

/// Complete checkpoints of a run, newest first.
std::vector<std::string> checkpoints_of(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : files::directory_iterator(folder + "/checkpoint", ignored)) {
    const std::string name = entry.path().filename();
    if (name.starts_with("window-") && !name.ends_with(".part")) found.push_back(entry.path());
  }
  std::sort(found.rbegin(), found.rend());
  return found;
}

/// checkpoint.json if the files it names are there in full length, else null.
nlohmann::json description_of(const std::string& checkpoint) {
  std::ifstream file(checkpoint + "/checkpoint.json");
  const auto j = nlohmann::json::parse(file, nullptr, false);
  if (!j.is_object() || !j.contains("sides") || !j["sides"].is_array()) return nullptr;
  for (const auto& side : j["sides"]) {
    std::error_code error;
    const auto size = files::file_size(checkpoint + "/" + side.value("name", "") + ".state", error);
    if (error || size != side.value("bytes", std::uintmax_t{0})) return nullptr;
  }
  return j;
}

Continuation choose_checkpoint(const std::string& folder, const CaseRead& read) {
  const std::vector<std::string> all = checkpoints_of(folder);
  if (all.empty())
    incompatible(fmt::format("{} has no checkpoint to go on from\n  standoff run {}/case.resolved.toml begins anew",
                             folder, folder));
  for (const std::string& checkpoint : all) {
    const nlohmann::json j = description_of(checkpoint);
    if (!j.is_object()) {
      std::fprintf(stderr, "standoff: warning: %s is damaged; the one before it is tried\n", checkpoint.c_str());
      continue;
    }
    if (j.value("case_hash", "") != read.hash)
      incompatible(
          fmt::format("{} was written for case hash {}, case.resolved.toml now has {}\n  a run is continued "
                      "with the case it was begun with",
                      checkpoint, j.value("case_hash", ""), read.hash));
    if (j.value("build", "") != build_id())
      incompatible(
          fmt::format("{} was written by another build\n  by:   {}\n  this: {}\n  only the same build goes on "
                      "with the same bits",
                      checkpoint, j.value("build", ""), build_id()));
    return {checkpoint, j.value("windows", 0L), j.value("time_s", 0.0), j.value("window_s", 0.0), 0.0};
  }
  incompatible(fmt::format("every checkpoint in {}/checkpoint is damaged", folder));
}

}  // namespace

int resume_verb(const RunOptions& options, const std::string& folder) {
  const RunFollower run(folder);
  const std::string status = run.status();
  if (status == "done")
    throw Stop(ExitCode::bad_case, fmt::format("{} is done: there is nothing to go on with", folder));
  if (status == "running")
    throw Stop(ExitCode::bad_case, fmt::format("{} is still running: standoff watch {} follows it", folder, folder));
  const CaseRead read = read_case(folder + "/case.resolved.toml");
  if (!print_diagnostics(read)) return static_cast<int>(ExitCode::bad_case);
  for (const char* name : {"standoff-broker", "standoff-structure", "standoff-particles"}) program_path(name);
  Continuation from = choose_checkpoint(folder, read);
  from.wall = std::max(run.wall_s(), 1e-3);
  RunSession session(options, read, folder, from);
  return session.run();
}

}  // namespace standoff::launch
