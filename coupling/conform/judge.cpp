#include <signal.h>

#include "coupling/base/stop.hpp"
#include "coupling/conform/rules.hpp"

namespace standoff::conform {
namespace {

/// Every rule also asks that nothing is left behind.
std::string objection(const Rule& rule, Play& play) {
  try {
    rule.play(play);
    play.peer.signal(SIGTERM);
    play.peer.call_off();
    play.peer.wait_end(10.0);
    const std::string left = play.peer.leftovers();
    return left.empty() ? "" : "it left " + left;
  } catch (const RuleBroken& broken) {
    return broken.what();
  }
}

}  // namespace

Verdict judge(const Rule& rule, const Subject& subject) {
  Play play(subject);
  Verdict verdict;
  verdict.rule = &rule;
  verdict.reason = objection(rule, play);
  verdict.passed = verdict.reason.empty();
  verdict.seconds = play.peer.seconds();
  return verdict;
}

}  // namespace standoff::conform
