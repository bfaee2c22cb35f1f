#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/report_script.hpp"
#include "coupling/launcher/run_follower.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

int report_verb(const ReportOptions& options) {
  for (const std::string& folder : options.folders) read_record(folder);
  std::vector<std::string> arguments{"--out",
                                     options.out.empty() ? options.folders.front() + "/report.html" : options.out};
  arguments.insert(arguments.end(), options.folders.begin(), options.folders.end());
  const std::string trouble = run_report_script("run_report.py", arguments);
  if (!trouble.empty())
    throw Stop(ExitCode::check_failed, fmt::format("no report was written: {}\n  it needs /usr/bin/python3", trouble));
  return static_cast<int>(ExitCode::done);
}

}  // namespace standoff::launch
