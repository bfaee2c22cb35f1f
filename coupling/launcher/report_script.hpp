#pragma once
// The scripts of coupling/report, beside the installed program or in the source tree, run by Debian's Python.
#include <string>
#include <vector>

namespace standoff::launch {

/// "" if the script could be found and ended well, else why not. What it prints goes to standard output.
std::string run_report_script(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace standoff::launch
