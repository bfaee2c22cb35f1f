#include <CLI/CLI.hpp>

#include "coupling/launcher/command_line_verbs.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {
namespace {

Action add_follower(CLI::App& app, const char* name, const char* help, int (*call)(const FolderOptions&),
                    const char* json_help) {
  auto options = std::make_shared<FolderOptions>();
  CLI::App& verb = *app.add_subcommand(name, help);
  verb.add_option("RUN", options->folder, "a run folder, e.g. runs/dry_150mm/coarse-1")->required()->type_name("");
  verb.add_flag("--json", options->json, json_help);
  return [options, call] { return call(*options); };
}

Action add_compare(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App& verb = *app.add_subcommand("compare", "what differs between two runs: inputs, results, timings");
  verb.add_option("A", options->first, "a run folder")->required()->type_name("");
  verb.add_option("B", options->second, "another; differences are B - A, relative to |A|")->required()->type_name("");
  verb.add_flag("--json", options->json, "the same as JSON");
  return [options] { return compare_verb(*options); };
}

Action add_report(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App& verb = *app.add_subcommand("report", "one HTML page of one or several runs, with figures; opens offline");
  verb.add_option("RUN", options->folders, "run folders")->required()->type_name("");
  verb.add_option("--out", options->out, "the page (default: report.html in the first run folder)")->type_name("FILE");
  return [options] { return report_verb(*options); };
}

}  // namespace

void add_folder_verbs(CLI::App& app, Actions& actions) {
  actions["status"] = add_follower(app, "status", "one snapshot of a run: where it is, or how it ended", status_verb,
                                   "the same as JSON");
  actions["watch"] = add_follower(app, "watch", "follows a run to its end and returns its exit code", watch_verb,
                                  "one JSON object a line");
  actions["compare"] = add_compare(app);
  actions["report"] = add_report(app);
}

}  // namespace standoff::launch
