#include <cstdio>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/run_comparison.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {

int compare_verb(const CompareOptions& options) {
  const OrderedJson j = comparison_json(compared_run(options.first), compared_run(options.second));
  if (options.json)
    std::printf("%s\n", j.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  else
    std::fputs(comparison_text(j).c_str(), stdout);
  return static_cast<int>(ExitCode::done);
}

}  // namespace standoff::launch
