#include "particle_solver/app/cell_program.hpp"

#include <cstring>
#include <iostream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/case_reader.hpp"
#include "coupling/contract/participant_main.hpp"
#include "coupling/output/atomic_file.hpp"
#include "particle_solver/app/cell_files.hpp"

namespace standoff::particles {
namespace {

struct CellCommand {
  std::string case_file, out;
  int threads = 1;
  bool only_help = false;
};

CellCommand read_command(int argc, char** argv) {
  CellCommand command;
  CLI::App app("Packs and compresses the unit cell of a case's soil", "standoff-particles cell");
  app.add_option("--case", command.case_file, "case.toml or case.resolved.toml")->required();
  app.add_option("--out", command.out, "folder for cell.json, stress_strain.csv and cells.csv")->required();
  app.add_option("--threads", command.threads, "threads of this process")->check(CLI::Range(1, 1024));
  try {
    app.parse(argc - 1, argv + 1);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    command.only_help = true;
  } catch (const CLI::ParseError& error) {
    throw Stop(ExitCode::bad_case, fmt::format("{}; standoff-particles cell --help shows the options", error.what()));
  }
  return command;
}

CaseSpec read_cell_case(const std::string& file) {
  CaseOverrides overrides;
  overrides.purpose = CasePurpose::cell;
  CaseRead read = read_case(file, overrides);
  for (const std::string& error : read.errors) std::cerr << error << '\n';
  if (!read.errors.empty()) throw Stop(ExitCode::bad_case, fmt::format("{} errors in the case", read.errors.size()));
  return std::move(read.spec);
}

}  // namespace

bool asks_for_cell(int argc, char** argv) {
  return argc > 1 && std::strcmp(argv[1], "cell") == 0;
}

int cell_program(int argc, char** argv) {
  return participant_main("standoff-particles", [&] {
    const CellCommand command = read_command(argc, argv);
    if (command.only_help) return;
    const CaseSpec spec = read_cell_case(command.case_file);
    const CellStudy study =
        study_cells(spec.soil, spec.cell, spec.run.seed, command.threads, spec.effect("grain_rotation"));
    write_atomically(command.out + "/stress_strain.csv", stress_strain_csv(study, spec.soil.stiffness));
    write_atomically(command.out + "/cells.csv", cells_csv(study));
    write_atomically(command.out + "/cell.json", cell_json(spec, study));
  });
}

}  // namespace standoff::particles
