#include "coupling/launcher/build_facts.hpp"

#include <fstream>

#include <nlohmann/json.hpp>
#include <sched.h>

#include "standoff_build_facts.hpp"

namespace standoff::launch {

const BuildFacts& build_facts() {
  static const BuildFacts facts = [] {
    BuildFacts f{STANDOFF_FACT_VERSION, STANDOFF_FACT_GIT, "g++ " __VERSION__, STANDOFF_FACT_FLAGS, {},
                 STANDOFF_FACT_SOURCE};
    f.libraries = nlohmann::json::parse(STANDOFF_FACT_LIBRARIES).get<std::map<std::string, std::string>>();
    return f;
  }();
  return facts;
}

std::string build_id() {
  const BuildFacts& facts = build_facts();
  return facts.version + " " + facts.git + ", " + facts.compiler + ", " + facts.flags;
}

int usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? std::max(1, CPU_COUNT(&set)) : 1;
}

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  std::string line, name = "unknown";
  while (std::getline(info, line))
    if (line.starts_with("model name")) {
      name = line.substr(line.find(':') + 2);
      break;
    }
  return name + ", " + std::to_string(usable_cores()) + " cores";
}

}  // namespace standoff::launch
