#include "coupling/session/messages.hpp"

#include <array>

namespace standoff {

const char* message_name(std::size_t kind) {
  static constexpr std::array<const char*, message_kinds> names = {
      "HELLO", "WELCOME", "REJECT", "SURFACE", "READY",    "START",  "GRANT",  "ADVANCE",    "STOP",
      "BEAT",  "ABORT",   "BYE",    "BYE_ACK", "PROGRESS", "SAMPLE", "REPORT", "CHECKPOINT", "SAVED"};
  return names.at(kind);
}

const char* role_name(Role role) {
  return role == Role::load ? "load" : "structure";
}

std::string first_cause(const message::Abort& failure) {
  std::string text = "first cause: " + failure.origin;
  if (failure.window >= 0) text += ", window " + std::to_string(failure.window);
  return text + ": " + failure.reason;
}

}  // namespace standoff
