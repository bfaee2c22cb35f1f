// standoff-replay: a tape in place of the load side or of the structure.
//   standoff-replay --tape FILE --role load|structure  and the options of every participant
#include <cstdio>
#include <cstring>
#include <vector>

#include "coupling/base/stop.hpp"
#include "coupling/contract/participant_program.hpp"
#include "coupling/replay/replay.hpp"

namespace {

/// Takes "NAME VALUE" out of the arguments.
std::string take_option(std::vector<char*>& arguments, const char* name) {
  for (std::size_t i = 1; i + 1 < arguments.size(); ++i)
    if (std::strcmp(arguments[i], name) == 0) {
      const std::string value = arguments[i + 1];
      arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i),
                      arguments.begin() + static_cast<std::ptrdiff_t>(i) + 2);
      return value;
    }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  using namespace standoff;
  std::vector<char*> arguments(argv, argv + argc);
  const std::string path = take_option(arguments, "--tape"), role = take_option(arguments, "--role");
  const bool load = role == "load";
  if (path.empty() || (!load && role != "structure")) {
    std::fprintf(stderr, "standoff-replay: error: --tape FILE and --role load|structure are needed\n");
    return static_cast<int>(ExitCode::bad_case);
  }
  const ParticipantIdentity identity{"standoff-replay", load ? "particles" : "structure",
                                     load ? Role::load : Role::structure, "A recorded side of a coupled run", false};
  arguments.push_back(nullptr);
  return participant_program(static_cast<int>(arguments.size()) - 1, arguments.data(), identity,
                             [&](const CaseSpec& spec, const ParticipantCommand&, Participant& link) {
                               TapeReader tape(path);
                               load ? replay_load(spec, tape, link) : replay_structure(spec, tape, link);
                             });
}
