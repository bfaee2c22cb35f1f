#pragma once
// What the checks of a scene share: when a finding can be made, and where it points.
#include <algorithm>
#include <string>
#include <vector>

#include "coupling/case/case_spec.hpp"
#include "coupling/case/settings.hpp"

namespace standoff {

// Bodies given as equal decimals may touch: 76.2 mm against 76.2 mm. One part in 1e9 is far above rounding and far
// below any distance of interest.
inline constexpr double touching = 1e-9;

inline std::string mm(double metres) {
  return readable_text(metres, quantity::length);
}

class SceneFindings {
 public:
  SceneFindings(const CaseSpec& spec, const Settings& settings, Diagnostics& diagnostics)
      : spec_(spec), settings_(settings), diagnostics_(diagnostics) {}

 protected:
  using Paths = std::vector<std::string>;

  /// Nothing that a finding rests on may be missing or wrong already.
  bool usable(const Paths& paths) const {
    return std::all_of(paths.begin(), paths.end(),
                       [this](const std::string& path) { return settings_.has(path) && !settings_.is_wrong(path); });
  }
  void finding(bool wrong, const Paths& paths, const std::string& message, const std::string& hint) {
    if (wrong) diagnostics_.error(settings_.blame(paths), message, hint);
  }

  const CaseSpec& spec_;
  const Settings& settings_;
  Diagnostics& diagnostics_;
};

}  // namespace standoff
