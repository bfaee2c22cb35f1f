#include "coupling/launcher/report_script.hpp"

#include <cstdio>
#include <filesystem>

#include "coupling/launcher/build_facts.hpp"
#include "coupling/launcher/child_process.hpp"
#include "coupling/launcher/cost_study.hpp"

namespace standoff::launch {
namespace {

std::string path_of(const std::string& script) {
  for (const std::string& folder :
       {program_folder() + "/../share/standoff/report", build_facts().source_folder + "/coupling/report"})
    if (std::error_code ignored; std::filesystem::exists(folder + "/" + script, ignored)) return folder + "/" + script;
  return "";
}

}  // namespace

std::string run_report_script(const std::string& script, const std::vector<std::string>& arguments) {
  const std::string path = path_of(script);
  if (path.empty()) return "the report scripts are not installed";
  // -B: nothing is written beside the scripts, which may be installed where others own the folder.
  std::vector<std::string> command{"/usr/bin/python3", "-B", path};
  command.insert(command.end(), arguments.begin(), arguments.end());
  std::fflush(stdout);
  const auto cause = run_to_end("report", command, [](const std::string& line) { std::printf("%s\n", line.c_str()); });
  return cause ? cause->what : "";
}

}  // namespace standoff::launch
