// The verbs that tell what exists: doc, effects, presets, models.
#include <cstdio>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/catalogue.hpp"
#include "coupling/launcher/verbs.hpp"

namespace standoff::launch {
namespace {

int print(bool as_json, const OrderedJson& json, const std::string& text) {
  std::printf("%s%s", as_json ? json.dump(2).c_str() : text.c_str(), as_json ? "\n" : "");
  return static_cast<int>(ExitCode::done);
}

}  // namespace

int doc_verb(const DocOptions& options) {
  if (options.key.empty()) return print(options.json, sections_json(), sections_text());
  const std::vector<std::string> paths = keys_named(options.key);
  if (!paths.empty()) return print(options.json, keys_json(paths), keys_text(paths));
  if (const std::string text = free_entry_text(options.key); !text.empty())
    return print(options.json, {{{"key", options.key}, {"doc", text}}}, options.key + "\n  " + text + "\n");
  std::fprintf(stderr, "standoff: error: %s\n", unknown_key_text(options.key).c_str());
  return static_cast<int>(ExitCode::bad_case);
}

int effects_verb(bool json) {
  return print(json, effects_json(), effects_text());
}

int presets_verb(bool json) {
  return print(json, presets_json(), presets_text());
}

int models_verb(bool json) {
  return print(json, models_json(), models_text());
}

}  // namespace standoff::launch
