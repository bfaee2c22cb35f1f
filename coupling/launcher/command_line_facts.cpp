#include <CLI/CLI.hpp>

#include "coupling/launcher/command_line_verbs.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {
namespace {

Action add_doc(CLI::App& app) {
  auto options = std::make_shared<DocOptions>();
  CLI::App& verb = *app.add_subcommand("doc", "what a key of a case means, takes, and is by default");
  verb.add_option("KEY", options->key, "plate.size, size, or a section such as plate (default: list everything)")
      ->type_name("");
  verb.add_flag("--json", options->json, "the same as JSON");
  return [options] { return doc_verb(*options); };
}

Action add_list(CLI::App& app, const char* name, const char* help, int (*list)(bool json)) {
  auto json = std::make_shared<bool>(false);
  app.add_subcommand(name, help)->add_flag("--json", *json, "the same as JSON");
  return [json, list] { return list(*json); };
}

Action add_new(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  CLI::App& verb = *app.add_subcommand("new", "a commented template case");
  verb.add_option("FOLDER", *folder, "where to write case.toml; never overwrites (default: print it)")->type_name("");
  return [folder] { return new_verb(*folder); };
}

}  // namespace

void add_fact_verbs(CLI::App& app, Actions& actions) {
  actions["doc"] = add_doc(app);
  actions["effects"] = add_list(app, "effects", "every effect and what it is", effects_verb);
  actions["presets"] = add_list(app, "presets", "named sets of constants, in SI, with their sources", presets_verb);
  actions["models"] = add_list(app, "models", "structural models: what each resolves and leaves out", models_verb);
  actions["new"] = add_new(app);
}

}  // namespace standoff::launch
