#include "coupling/contract/participant_program.hpp"

#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/case_reader.hpp"
#include "coupling/contract/participant_main.hpp"
#include "coupling/transport/endpoint.hpp"

namespace standoff {
namespace {

CaseRead read_or_stop(const ParticipantCommand& command) {
  CaseOverrides overrides;
  overrides.level = command.level;
  CaseRead read = read_case(command.case_file, overrides);
  if (read.errors.empty()) return read;
  for (const std::string& error : read.errors) std::cerr << error << '\n';
  throw Stop(ExitCode::bad_case, fmt::format("{} errors in the case", read.errors.size()));
}

}  // namespace

ParticipantCommand participant_command(int argc, char** argv, const ParticipantIdentity& identity) {
  ParticipantCommand command;
  CLI::App app(identity.does, identity.program);
  app.add_option("--case", command.case_file, "case.toml or case.resolved.toml")->required();
  app.add_option("--level", command.level, "level of an unresolved case");
  app.add_option("--connect", command.endpoint, "address of the broker, ipc://PATH or tcp://HOST:PORT")
      ->required()
      ->check(why_out_of_reach);
  app.add_option("--token", command.token, "run token, the broker's");
  app.add_option("--curve-secret", command.curve_secret, "file with our secret key, for a broker on another host")
      ->envname("STANDOFF_CURVE_SECRET");
  app.add_option("--curve-server", command.curve_server, "file with the public key of the broker")
      ->envname("STANDOFF_CURVE_SERVER");
  app.add_flag("--insecure", command.insecure, "go to a broker on another host unencrypted");
  app.add_option("--out", command.out, "run folder for frames and maps; without it nothing is written");
  app.add_option("--trace", command.trace, "file for what was done when, one trace event a line");
  app.add_option("--threads", command.threads, "threads of this process")->check(CLI::Range(1, 1024));
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    command.only_help = true;
  } catch (const CLI::ParseError& error) {
    throw Stop(ExitCode::bad_case, fmt::format("{}; {} --help shows the options", error.what(), identity.program));
  }
  return command;
}

int participant_program(int argc, char** argv, const ParticipantIdentity& identity, const ParticipantBody& body) {
  return participant_main(identity.program, [&] {
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
      throw Stop(ExitCode::bad_case, "this processor has no AVX2 and FMA instructions, which Standoff needs");
    const ParticipantCommand command = participant_command(argc, argv, identity);
    if (command.only_help) return;
    const CaseRead read = read_or_stop(command);
    ParticipantOptions options;
    options.name = identity.name;
    options.role = identity.role;
    options.endpoint = command.endpoint;
    options.token = command.token;
    options.case_hash = read.hash;
    options.keeps = identity.keeps;
    options.trace = command.trace;
    options.keys = read_participant_keys(command.curve_secret, command.curve_server);
    options.insecure = command.insecure;
    with_link(options, [&](Participant& link) { body(read.spec, command, link); });
  });
}

}  // namespace standoff
