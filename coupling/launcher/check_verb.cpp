#include <cstdio>

#include <nlohmann/json.hpp>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

bool print_diagnostics(const CaseRead& read) {
  for (const std::string& warning : read.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  for (const std::string& error : read.errors) std::fprintf(stderr, "%s\n", error.c_str());
  const std::size_t count = read.errors.size();
  if (count > 0) std::fprintf(stderr, "%zu error%s, nothing was started.\n", count, count == 1 ? "" : "s");
  return count == 0;
}

int check_verb(const CheckOptions& options) {
  CaseOverrides overrides = options.overrides;
  overrides.purpose = CasePurpose::either;
  const CaseRead read = read_case(options.case_path, overrides);
  const bool good = read.errors.empty();
  if (options.json) {
    const nlohmann::json j{{"case", read.spec.name},
                           {"ok", good},
                           {"errors", read.errors},
                           {"warnings", read.warnings},
                           {"hash", read.hash}};
    std::printf("%s\n", j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else if (print_diagnostics(read)) {
    std::printf("%s: no errors%s%s\n", options.case_path.c_str(), read.spec.level.empty() ? "" : ", level ",
                read.spec.level.c_str());
  }
  return static_cast<int>(good ? ExitCode::done : ExitCode::bad_case);
}

}  // namespace standoff::launch
