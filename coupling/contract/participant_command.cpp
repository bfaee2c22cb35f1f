#include "coupling/contract/participant_command.hpp"

#include <iostream>

#include <CLI/CLI.hpp>

#include "coupling/base/stop.hpp"

namespace standoff {

ParticipantCommand participant_command(int argc, char** argv, const std::string& program, const std::string& does) {
  ParticipantCommand command;
  CLI::App app(does, program);
  app.add_option("--case", command.case_file, "case.toml or case.resolved.toml")->required();
  app.add_option("--level", command.level, "level of an unresolved case");
  app.add_option("--connect", command.endpoint, "address of the broker, ipc://PATH or tcp://HOST:PORT")->required();
  app.add_option("--token", command.token, "run token, the broker's");
  app.add_option("--out", command.out, "run folder for frames and maps; without it nothing is written");
  app.add_option("--threads", command.threads, "threads of this process")->check(CLI::Range(1, 1024));
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    command.only_help = true;
  } catch (const CLI::ParseError& error) {
    throw Stop(ExitCode::bad_case, std::string(error.what()) + "; " + program + " --help shows the options");
  }
  return command;
}

}  // namespace standoff
