// standoff-particles: the load side of a coupled run. A small start, so that an old processor gets a message and not an
// illegal instruction: nothing here is compiled for AVX2, everything numerical is.
#include <iostream>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/case_reader.hpp"
#include "coupling/contract/participant_command.hpp"
#include "coupling/contract/participant_main.hpp"
#include "particle_solver/app/particle_run.hpp"

namespace {

constexpr const char* program = "standoff-particles";

standoff::CaseRead read_or_stop(const standoff::ParticipantCommand& command) {
  standoff::CaseOverrides overrides;
  overrides.level = command.level;
  standoff::CaseRead read = standoff::read_case(command.case_file, overrides);
  if (read.errors.empty()) return read;
  for (const std::string& error : read.errors) std::cerr << error << '\n';
  throw standoff::Stop(standoff::ExitCode::bad_case, fmt::format("{} errors in the case", read.errors.size()));
}

void run(int argc, char** argv) {
  using namespace standoff;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    throw Stop(ExitCode::bad_case, "this processor has no AVX2 and FMA instructions, which Standoff needs");
  const ParticipantCommand command = participant_command(argc, argv, program, "particles of a coupled run");
  if (command.only_help) return;
  const CaseRead read = read_or_stop(command);
  ParticipantOptions link;
  link.name = "particles";
  link.role = Role::load;
  link.endpoint = command.endpoint;
  link.token = command.token;
  link.case_hash = read.hash;
  with_link(link, [&](Participant& participant) {
    particles::run_particles(read.spec, {command.out, command.threads}, participant);
  });
}

}  // namespace

int main(int argc, char** argv) {
  return standoff::participant_main(program, [&] { run(argc, argv); });
}
