#pragma once
// Groups of verbs put on the command line; `run`, `check`, `plan`, `cost` and `cell` are in command_line.cpp.
#include <functional>
#include <map>
#include <string>

namespace CLI {
class App;
}

namespace standoff::launch {

/// What a verb does once its options are read.
using Action = std::function<int()>;
using Actions = std::map<std::string, Action>;

/// doc, effects, presets, models, new.
void add_fact_verbs(CLI::App& app, Actions& actions);
/// tape info, verify, diff, export.
void add_tape_verb(CLI::App& app, Actions& actions);
/// status, watch, compare, report.
void add_folder_verbs(CLI::App& app, Actions& actions);

}  // namespace standoff::launch
