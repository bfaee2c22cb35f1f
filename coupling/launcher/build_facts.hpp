#pragma once
// What this program was built from; written by coupling/launcher/launcher.cmake at every build.
#include <map>
#include <string>

namespace standoff::launch {

struct BuildFacts {
  std::string version, git, compiler, flags;
  std::map<std::string, std::string> libraries;
  std::string source_folder;  // where the report scripts lie when the program runs from its build folder
};

const BuildFacts& build_facts();
/// What a checkpoint must have been written by to be continued with the same bits: version, commit, compiler, flags.
std::string build_id();

/// "AMD EPYC 7R13, 2 cores": from /proc/cpuinfo and the cores this process may use.
std::string cpu_name();
int usable_cores();

}  // namespace standoff::launch
