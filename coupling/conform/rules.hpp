#pragma once
// What a participant must do, rule by rule: each is a short play with a fresh process. The wire they speak is described
// in proto/README.md.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coupling/conform/play.hpp"

namespace standoff::conform {

struct Rule {
  std::string name;           // short, for selection and for reports
  std::string text;           // what is asked, one sentence
  std::optional<Role> whose;  // nothing: of both sides
  std::function<void(Play&)> play;
};

/// Good runs: joining, the surface, windows, sums, heartbeats.
std::vector<Rule> rules_of_conduct();
/// Bad ones: refusals, failures of others, spoilt messages, signals.
std::vector<Rule> rules_of_failure();

struct Verdict {
  const Rule* rule = nullptr;
  bool passed = false;
  std::string reason;  // why not
  double seconds = 0.0;
};
Verdict judge(const Rule& rule, const Subject& subject);

}  // namespace standoff::conform
