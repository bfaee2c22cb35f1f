// standoff-conform: judges a participant program by the rules of the wire. `standoff conform` calls it.
#include <algorithm>
#include <cstdio>
#include <fstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "coupling/base/stop.hpp"
#include "coupling/case/case_reader.hpp"
#include "coupling/case/near_word.hpp"
#include "coupling/conform/judgement.hpp"

namespace {

using namespace standoff;
using namespace standoff::conform;

/// A small scene in which everything happens quickly; a participant of another kind brings its own with --case.
constexpr const char* small_case = R"([case]
name = "conform"
title = "a small charge before a coarse plate"
[charge]
explosive = "c4"
mass = "150 g"
particles = 200
[plate]
material = "al6xn"
size = ["406 mm", "406 mm", "3.4 mm"]
elements = [2, 2, 1]
[run]
stand_off = "150 mm"
until = "1 ms"
settle = false
)";

struct CommandLine {
  std::string case_path, level, junit, only;
  std::vector<std::string> set, command;
  bool list = false;
};

void declare(CLI::App& app, CommandLine& line) {
  app.add_option("--case", line.case_path, "case that the participant gets (default: a small one)")->type_name("CASE");
  app.add_option("--level", line.level, "level of that case")->type_name("NAME");
  app.add_option("--set", line.set, "any key of the case, e.g. --set plate.model=rigid_plate (may be repeated)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--rule", line.only, "this rule only")->type_name("NAME");
  app.add_option("--junit", line.junit, "write the verdicts as JUnit XML")->type_name("FILE");
  app.add_flag("--list", line.list, "print the rules and end");
  app.add_option("COMMAND", line.command,
                 "behind --: the program and its own options; --case, --connect, --token and --threads are added")
      ->type_name("");
}

std::vector<Rule> chosen_rules(const CommandLine& line) {
  std::vector<Rule> rules = rules_of_conduct();
  for (Rule& rule : rules_of_failure()) rules.push_back(std::move(rule));
  if (line.only.empty()) return rules;
  std::vector<std::string> names;
  for (const Rule& rule : rules) names.push_back(rule.name);
  std::erase_if(rules, [&](const Rule& rule) { return rule.name != line.only; });
  if (rules.empty())
    throw Stop(ExitCode::bad_case,
               fmt::format("no rule \"{}\"\n  {}", line.only, did_you_mean(line.only, names, "rules")));
  return rules;
}

CaseRead read(const CommandLine& line, const std::string& folder) {
  CaseOverrides overrides;
  overrides.level = line.level;
  for (const std::string& text : line.set) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw Stop(ExitCode::bad_case, fmt::format("--set \"{}\" is not KEY=VALUE", text));
    overrides.set.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  std::string path = line.case_path;
  if (path.empty()) std::ofstream(path = folder + "/case.toml") << small_case;
  CaseRead read = read_case(path, overrides);
  for (const std::string& error : read.errors) std::fprintf(stderr, "%s\n", error.c_str());
  if (!read.errors.empty()) throw Stop(ExitCode::bad_case, fmt::format("{} errors in the case", read.errors.size()));
  return read;
}

/// The path of a program as execve wants it.
std::string found_in_path(const std::string& program) {
  if (program.find('/') != std::string::npos) return program;
  const std::string beside = launch::program_folder() + "/" + program;
  if (access(beside.c_str(), X_OK) == 0) return beside;
  const char* list = std::getenv("PATH");
  std::string folders = list ? list : "/usr/bin:/bin";
  for (std::size_t at = 0; at <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', at), folders.size());
    const std::string path = folders.substr(at, end - at) + "/" + program;
    if (access(path.c_str(), X_OK) == 0) return path;
    at = end + 1;
  }
  throw Stop(ExitCode::bad_case, fmt::format("there is no program \"{}\" beside standoff or in PATH", program));
}

Role role_of(const Subject& subject) {
  Play play(subject);
  try {
    play.hello();
  } catch (const RuleBroken& broken) {
    throw Stop(ExitCode::check_failed, fmt::format("it does not join: {}", broken.what()));
  }
  return play.role;
}

int run(CommandLine& line) {
  const std::vector<Rule> rules = chosen_rules(line);
  if (line.list) {
    for (const Rule& rule : rules)
      std::printf("%-16s %s%s\n", rule.name.c_str(), rule.text.c_str(),
                  rule.whose ? fmt::format(" ({} only)", role_name(*rule.whose)).c_str() : "");
    return 0;
  }
  if (line.command.empty())
    throw Stop(ExitCode::bad_case, "a command is missing: standoff conform -- PROGRAM [OPTION ...]");
  const launch::PrivateFolder folder;
  const CaseRead given = read(line, folder.path());
  Subject subject{line.command, folder.path() + "/case.resolved.toml", given.spec};
  subject.command[0] = found_in_path(subject.command[0]);
  std::ofstream(subject.case_file) << given.resolved;

  const Role role = role_of(subject);
  std::printf("%s: the %s side\n", fmt::format("{}", fmt::join(line.command, " ")).c_str(), role_name(role));
  std::vector<Verdict> verdicts;
  for (const Rule& rule : rules) {
    if (rule.whose && *rule.whose != role) continue;
    verdicts.push_back(judge(rule, subject));
    std::printf("%s", verdict_text(verdicts.back()).c_str());
    std::fflush(stdout);
  }
  const auto failed = std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return !v.passed; });
  std::printf("%zu rules, %ld failed\n", verdicts.size(), static_cast<long>(failed));
  if (!line.junit.empty()) {
    std::ofstream file(line.junit);
    file << junit_text(fmt::format("{}", fmt::join(line.command, " ")), verdicts);
    if (!file.flush()) throw Stop(ExitCode::out_of_resources, "cannot write " + line.junit);
  }
  return failed == 0 ? 0 : static_cast<int>(ExitCode::check_failed);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Judges a participant program by the rules of the wire (proto/README.md), each with a fresh process.",
               "standoff conform");
  CommandLine line;
  declare(app, line);
  try {
    app.parse(argc, argv);
    return run(line);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::bad_case);
  } catch (const Stop& stop) {
    std::fprintf(stderr, "standoff conform: error: %s\n", stop.what());
    return static_cast<int>(stop.code());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "standoff conform: error: %s\n", error.what());
    return static_cast<int>(ExitCode::participant_lost);
  }
}
