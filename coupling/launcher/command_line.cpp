#include "coupling/launcher/command_line.hpp"

#include <cstdio>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/near_word.hpp"
#include "coupling/launcher/build_facts.hpp"
#include "coupling/launcher/command_line_verbs.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {
namespace {

constexpr const char* closing =
    R"(Exit codes: 0 done, 1 a check failed, 2 wrong case or command line (nothing was started), 3 stopped by a guard,
4 a participant was lost, 5 out of time, memory or disk, 6 checkpoint incompatible, 130 interrupted.)";

struct Texts {
  std::vector<std::string> set;
  std::string max_time, progress, checkpoint = "60 s", particles;
};

void add_case(CLI::App& verb, std::string& path) {
  verb.add_option("CASE", path, "folder with a case.toml, or the file")->required()->type_name("");
}

void add_overrides(CLI::App& verb, CaseOverrides& overrides, Texts& texts, bool with_axes) {
  if (with_axes) {
    verb.add_option("--level", overrides.level, "level of resolution, e.g. coarse")->type_name("NAME");
    verb.add_option("--seed", overrides.seed, "seed of the random numbers")->type_name("N");
  }
  verb.add_option("--set", texts.set, "any key of the case, e.g. --set run.until=\"1 ms\" (may be repeated)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb.add_option(
          "--structure", overrides.structure_model,
          "structural model instead of the case's; run also takes exec:COMMAND, another program (proto/README.md)")
      ->type_name("MODEL");
}

void add_threads(CLI::App& verb, ThreadOptions& threads) {
  verb.add_option("--threads", threads.both, "threads of each process (default: from the prediction)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  verb.add_option("--particle-threads", threads.particles, "threads of the particle process")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  verb.add_option("--structure-threads", threads.structure, "threads of the structure process")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
}

void add_max_time(CLI::App& verb, Texts& texts, const char* help) {
  verb.add_option("--max-time", texts.max_time, help)->type_name("T");
}

CaseOverrides with_set(CaseOverrides overrides, const Texts& texts) {
  for (const std::string& text : texts.set) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Stop(ExitCode::bad_case, fmt::format("--set \"{}\" is not KEY=VALUE, e.g. --set run.until=\"1 ms\"", text));
    overrides.set.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return overrides;
}

/// "--structure exec:COMMAND" names a program, not a model. Only the command line can: a case is data and starts
/// nothing.
void take_structure_command(RunOptions& options) {
  constexpr std::string_view prefix = "exec:";
  std::string& model = options.overrides.structure_model;
  if (!model.starts_with(prefix)) return;
  options.structure_command = model.substr(prefix.size());
  model.clear();
  if (options.structure_command.find_first_not_of(" \t") == std::string::npos)
    throw Stop(ExitCode::bad_case, "--structure exec: names no program, e.g. --structure \"exec:python3 plate.py\"");
}

/// "replay:TAPE" in place of one side.
void take_replays(RunOptions& options, const Texts& texts) {
  constexpr std::string_view prefix = "replay:";
  std::string& model = options.overrides.structure_model;
  if (model.starts_with(prefix)) options.structure_tape = model.substr(prefix.size()), model.clear();
  if (texts.particles.starts_with(prefix)) options.particle_tape = texts.particles.substr(prefix.size());
  if (!texts.particles.empty() && options.particle_tape.empty())
    throw Stop(ExitCode::bad_case, "--particles takes replay:TAPE, a file written by standoff run --tape");
}

double max_time_of(const Texts& texts) {
  return texts.max_time.empty() ? 0.0 : wall_seconds(texts.max_time);
}

void add_progress(CLI::App& verb, Texts& texts) {
  verb.add_option("--progress", texts.progress, "json: one JSON object a line instead of the progress line")
      ->type_name("FORMAT")
      ->check(CLI::IsMember({"json", "text"}));
  verb.add_option("--checkpoint", texts.checkpoint,
                  "when to save: off, a wall-clock time (90 s, 5 min) or a count (200 windows)")
      ->type_name("T")
      ->capture_default_str();
}

void take_texts(RunOptions& options, const Texts& texts) {
  options.max_time = max_time_of(texts);
  options.json = texts.progress == "json";
  options.checkpoint = checkpoint_options(texts.checkpoint);
}

Action add_run(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  auto texts = std::make_shared<Texts>();
  CLI::App& verb = *app.add_subcommand("run", "runs a case: starts the processes, watches them, prints the result");
  add_case(verb, options->case_path);
  add_overrides(verb, options->overrides, *texts, true);
  verb.add_option("--out", options->out, "run folder (default runs/CASE/LEVEL-NUMBER)")->type_name("DIR");
  add_threads(verb, options->threads);
  add_max_time(verb, *texts, "stop after this wall-clock time (90, 15 min, 2 h) with exit code 5");
  verb.add_flag("--quiet", options->quiet, "print errors only");
  verb.add_option("--tape", options->tape, "records every exchange of the interface in this file")->type_name("FILE");
  verb.add_option("--trace", options->trace, "what each process did when, for ui.perfetto.dev or chrome://tracing")
      ->type_name("FILE");
  verb.add_option("--particles", texts->particles,
                  "replay:TAPE, a recorded load instead of the particles; --structure replay:TAPE, a recorded motion")
      ->type_name("replay:TAPE");
  add_progress(verb, *texts);
  return [options, texts] {
    options->overrides = with_set(options->overrides, *texts);
    take_structure_command(*options);
    take_replays(*options, *texts);
    take_texts(*options, *texts);
    return run_verb(*options);
  };
}

Action add_resume(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  auto texts = std::make_shared<Texts>();
  auto folder = std::make_shared<std::string>();
  CLI::App& verb = *app.add_subcommand("resume", "goes on with a stopped run from its last checkpoint, bit for bit");
  verb.add_option("RUN", *folder, "a run folder, e.g. runs/dry_150mm/coarse-1")->required()->type_name("");
  add_threads(verb, options->threads);
  add_max_time(verb, *texts, "stop after this wall-clock time, counted from now, with exit code 5");
  verb.add_flag("--quiet", options->quiet, "print errors only");
  add_progress(verb, *texts);
  return [options, texts, folder] {
    take_texts(*options, *texts);
    return resume_verb(*options, *folder);
  };
}

Action add_check(CLI::App& app) {
  auto options = std::make_shared<CheckOptions>();
  auto texts = std::make_shared<Texts>();
  CLI::App& verb = *app.add_subcommand("check", "every error of a case at once; starts nothing");
  add_case(verb, options->case_path);
  add_overrides(verb, options->overrides, *texts, true);
  verb.add_flag("--json", options->json, "errors and warnings as JSON");
  return [options, texts] {
    options->overrides = with_set(options->overrides, *texts);
    return check_verb(*options);
  };
}

Action add_plan(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  auto texts = std::make_shared<Texts>();
  CLI::App& verb = *app.add_subcommand("plan", "what a case will simulate and why, and what it will cost");
  add_case(verb, options->case_path);
  add_overrides(verb, options->overrides, *texts, true);
  add_threads(verb, options->threads);
  verb.add_flag("--json", options->json, "the same as JSON");
  return [options, texts] {
    options->overrides = with_set(options->overrides, *texts);
    return plan_verb(*options);
  };
}

Action add_cost(CLI::App& app) {
  auto options = std::make_shared<CostOptions>();
  auto texts = std::make_shared<Texts>();
  CLI::App& verb =
      *app.add_subcommand("cost", "what accuracy costs: runs levels with several seeds, compares error and time");
  add_case(verb, options->case_path);
  add_overrides(verb, options->overrides, *texts, false);
  verb.add_option("--levels", options->levels, "levels to run, separated by commas (default: all that fit the budget)")
      ->type_name("A,B,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  verb.add_option("--seeds", options->seeds, "runs of each level")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  auto budget = std::make_shared<std::string>("30 min");
  verb.add_option("--budget", *budget, "predicted wall-clock time of all runs that is not exceeded")
      ->type_name("T")
      ->capture_default_str();
  verb.add_option("--out", options->out, "study folder, continued if it exists (default runs/CASE/cost-NUMBER)")
      ->type_name("DIR");
  add_threads(verb, options->threads);
  add_max_time(verb, *texts, "wall-clock limit of one run");
  verb.add_flag("--effects", options->effects, "what each effect costs and changes, at one level");
  verb.add_flag("--quiet", options->quiet, "print the table only");
  return [options, texts, budget] {
    options->overrides = with_set(options->overrides, *texts);
    options->max_time = max_time_of(*texts);
    options->budget = wall_seconds(*budget);
    return cost_verb(*options);
  };
}

Action add_cell(CLI::App& app) {
  auto options = std::make_shared<CellOptions>();
  auto texts = std::make_shared<Texts>();
  CLI::App& verb = *app.add_subcommand("cell", "unit cell of the sand: pack, compress, stress against strain");
  add_case(verb, options->case_path);
  verb.add_option("--seed", options->overrides.seed, "seed of the first cell")->type_name("N");
  verb.add_option("--set", texts->set, "any key of the case, e.g. --set soil.stiffness=\"0.2 GN/m\" (may be repeated)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb.add_option("--out", options->out, "folder (default runs/CASE/cell-NUMBER)")->type_name("DIR");
  verb.add_option("--threads", options->threads, "cells that are worked on at once (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024));
  verb.add_flag("--json", options->json, "the result as JSON");
  return [options, texts] {
    options->overrides = with_set(options->overrides, *texts);
    return cell_verb(*options);
  };
}

std::vector<std::string> option_names(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// CLI11 says only "not expected"; a user wants to know what was meant.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const auto verbs = app.get_subcommands();
  const CLI::App& where = verbs.empty() ? app : *verbs.front();
  for (const std::string& extra : where.remaining(true)) {
    if (extra.starts_with("-")) {
      const std::string name = extra.substr(0, extra.find('='));
      return fmt::format("unknown option {}\n  {}", name, did_you_mean(name, option_names(where), "options here"));
    }
    return fmt::format("\"{}\" is one argument too many; see standoff {} --help", extra, where.get_name());
  }
  return error.what();
}

int complain(const std::string& text) {
  std::fprintf(stderr, "standoff: error: %s\nnothing was started.\n", text.c_str());
  return static_cast<int>(ExitCode::bad_case);
}

int parse_and_call(CLI::App& app, const Actions& actions, int argc, char** argv) {
  std::vector<std::string> names;
  for (const auto& [name, action] : actions) names.push_back(name);
  names.emplace_back("conform");
  if (argc > 1 && argv[1] == std::string_view("conform")) return conform_verb(argv + 2);
  if (argc < 2) return complain("a verb is missing\n  " + did_you_mean("", names, "verbs") + "; see standoff --help");
  const std::string first = argv[1];
  if (!first.starts_with("-") && !actions.contains(first))
    return complain(fmt::format("unknown verb \"{}\"\n  {}", first, did_you_mean(first, names, "verbs")));
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& call) {
    return app.exit(call);
  } catch (const CLI::CallForVersion& call) {
    return app.exit(call);
  } catch (const CLI::ParseError& error) {
    return complain(explain(app, error));
  }
  return actions.at(app.get_subcommands().front()->get_name())();
}

}  // namespace

CheckpointOptions checkpoint_options(const std::string& text) {
  if (text == "off") return {false, 0.0, 0};
  std::istringstream words(text);
  long count = 0;
  std::string unit, rest;
  if (words >> count >> unit && unit.starts_with("window") && !(words >> rest)) {
    if (count > 0) return {true, 0.0, count};
    throw Stop(ExitCode::bad_case, "--checkpoint \"" + text + "\": a positive number of windows is needed");
  }
  return {true, wall_seconds(text), 0};
}

double wall_seconds(const std::string& text) {
  std::size_t used = 0;
  double value = -1.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
  }
  std::string unit = text.substr(used);
  unit.erase(0, unit.find_first_not_of(' '));
  const std::map<std::string, double> units{{"", 1.0}, {"s", 1.0}, {"min", 60.0}, {"h", 3600.0}};
  if (!(value > 0.0) || !units.contains(unit))
    throw Stop(ExitCode::bad_case, fmt::format("\"{}\" is not a wall-clock time; write 90, 90 s, 15 min or 2 h", text));
  return value * units.at(unit);
}

int launch(int argc, char** argv) {
  CLI::App app("Standoff: blast and sand against plates, particles and finite elements coupled.", "standoff");
  app.footer(closing);
  app.set_version_flag("--version", build_facts().version + " (" + build_facts().git + ")");
  app.require_subcommand(1);
  Actions actions{{"run", add_run(app)},   {"resume", add_resume(app)}, {"check", add_check(app)},
                  {"plan", add_plan(app)}, {"cost", add_cost(app)},     {"cell", add_cell(app)}};
  add_fact_verbs(app, actions);
  add_folder_verbs(app, actions);
  add_tape_verb(app, actions);
  app.add_subcommand("conform", "judges any participant program by the rules of the wire: conform -- COMMAND");
  try {
    return parse_and_call(app, actions, argc, argv);
  } catch (const Stop& stop) {
    std::fprintf(stderr, "standoff: error: %s\n", stop.what());
    if (stop.code() == ExitCode::bad_case) std::fprintf(stderr, "nothing was started.\n");
    return static_cast<int>(stop.code());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "standoff: error: out of memory\n");
    return static_cast<int>(ExitCode::out_of_resources);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "standoff: error: %s\n", error.what());
    return static_cast<int>(ExitCode::participant_lost);
  }
}

}  // namespace standoff::launch
