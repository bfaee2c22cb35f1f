// Which message is legal when: the rows of this table are the protocol.
#include <algorithm>
#include <array>

#include "coupling/session/session.hpp"

namespace standoff {
namespace {

template <class Body, std::size_t K = 0>
constexpr std::uint32_t bit() {
  if constexpr (std::is_same_v<Body, std::variant_alternative_t<K, Message>>)
    return 1u << K;
  else
    return bit<Body, K + 1>();
}
template <class... Bodies>
constexpr std::uint32_t set() {
  return (bit<Bodies>() | ...);
}

using namespace message;
constexpr std::uint32_t always = set<Beat, Abort>();
constexpr std::uint32_t telling = always | set<Progress, Sample>();

constexpr std::array<std::uint32_t, stage_count> legal = {
    /* absent    */ set<Hello>(),
    /* joined    */ telling | set<Surface>(),
    /* meshed    */ telling | set<Ready>(),
    /* ready     */ always,
    /* computing */ telling | set<Advance, StopWindows>(),
    /* waiting   */ telling | set<StopWindows>(),
    /* saving    */ telling | set<StopWindows, Saved>(),
    /* finishing */ telling | set<StopWindows, Report, Bye>(),  // STOP may cross ours
    /* closed    */ set<Beat>(),                                // one that crossed our BYE_ACK
};

}  // namespace

const char* stage_name(Stage stage) {
  static constexpr std::array<const char*, stage_count> names = {"absent",  "joined", "meshed",    "ready", "computing",
                                                                 "waiting", "saving", "finishing", "closed"};
  return names.at(static_cast<std::size_t>(stage));
}

bool may_send(Stage stage, std::size_t kind) {
  return kind < message_kinds && (legal.at(static_cast<std::size_t>(stage)) >> kind & 1u) != 0;
}

std::string expected_in(Stage stage) {
  std::string text;
  for (std::size_t kind = 0; kind < message_kinds; ++kind)
    if (may_send(stage, kind)) text += (text.empty() ? "" : ", ") + std::string(message_name(kind));
  return text;
}

}  // namespace standoff
