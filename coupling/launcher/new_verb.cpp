#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/template_case.hpp"
#include "coupling/launcher/verbs.hpp"
#include "coupling/output/atomic_file.hpp"

namespace standoff::launch {

int new_verb(const std::string& folder) {
  if (folder.empty()) {
    std::fputs(template_case, stdout);
    return static_cast<int>(ExitCode::done);
  }
  namespace files = std::filesystem;
  const std::string path = folder + "/case.toml";
  std::error_code error;
  if (files::exists(path, error))
    throw Stop(ExitCode::bad_case, fmt::format("{} exists and is not overwritten; choose another folder", path));
  files::create_directories(folder, error);
  if (error || !files::is_directory(folder, error))
    throw Stop(ExitCode::bad_case, fmt::format("cannot create the folder {}: {}", folder, error.message()));
  write_atomically(path, template_case);
  std::printf("%s written; next: edit it, then\n  standoff check %s\n  standoff plan %s\n  standoff run %s\n",
              path.c_str(), folder.c_str(), folder.c_str(), folder.c_str());
  return static_cast<int>(ExitCode::done);
}

}  // namespace standoff::launch
