#include "coupling/session/window_clock.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace standoff {
namespace {

double wanted_length(const WindowRule& rule, const WindowNeeds& load, const WindowNeeds& structure) {
  if (rule.kind == WindowRule::Kind::fixed) return rule.length;
  double length = structure.stable_step;
  if (rule.kind == WindowRule::Kind::structure_step) return length;
  double limit = 0.0;
  for (const double side : {load.window_limit, structure.window_limit})
    if (side > 0.0) limit = limit > 0.0 ? std::min(limit, side) : side;
  return std::max(length, limit);
}

}  // namespace

CouplingClock decide_clock(double until, bool parallel, const WindowRule& rule, const WindowNeeds& load,
                           const WindowNeeds& structure) {
  const double length = wanted_length(rule, load, structure);
  if (!(length > 0.0) || !std::isfinite(length))
    throw Stop(ExitCode::participant_lost,
               fmt::format("the window would be {} s long: the structure says its stable step is {} s", length,
                           structure.stable_step));
  // A length that divides the run up to rounding must not cost one window more.
  const double count = std::max(1.0, std::ceil(until / length * (1.0 - 1e-12)));
  if (count > 1e9)
    throw Stop(ExitCode::bad_case,
               fmt::format("a window of {} s makes {:.3g} windows until {} s; at most 1e9: choose a "
                           "longer window",
                           length, count, until));
  CouplingClock clock;
  clock.windows = static_cast<std::int64_t>(count);
  clock.window = until / count;
  clock.parallel = parallel;
  return clock;
}

}  // namespace standoff
