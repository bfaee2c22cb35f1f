#include "coupling/launcher/catalogue.hpp"

#include <cmath>

#include <fmt/format.h>

#include "coupling/case/effects/registry.hpp"
#include "coupling/case/near_word.hpp"
#include "coupling/case/presets.hpp"
#include "coupling/case/schema.hpp"
#include "coupling/case/structural_models.hpp"
#include "coupling/launcher/text_format.hpp"

namespace standoff::launch {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr const char* kind_names[] = {"quantity", "number",     "count",  "flag", "text",
                                      "choice",   "quantities", "counts", "list"};

struct FreeEntry {
  const char *name, *doc;
};
// Beyond the table of keys: sections whose keys are names, and the list of files.
constexpr FreeEntry free_entries[] = {{"case.use", "list of files that the case builds on; what the case states wins"},
                                      {"effects", "NAME = \"on\" or \"off\"; see `standoff effects`"},
                                      {"levels", "NAME: a table of its own, [levels.NAME]"},
                                      {"references", "published or measured figures: quantity, value, source"}};

std::string bracket_in(std::string_view text) {
  const auto begin = text.find('['), end = text.find(']');
  return begin == std::string_view::npos || end == std::string_view::npos
             ? ""
             : std::string(text.substr(begin, end - begin + 1));
}

std::string value_in_SI(const PresetValue& value) {
  const KeyEntry* key = find_key(value.path);
  if (key == nullptr || key->kind != KeyKind::quantity) return std::string(value.text);
  return exact_text(parse_quantity(value.text).value, key->quantity);
}

std::string source_of(const Preset& preset, const PresetValue& value) {
  if (!value.source.empty()) return std::string(value.source);
  const KeyEntry* key = find_key(value.path);
  return key != nullptr && !key->source.empty() ? std::string(key->source) : bracket_in(preset.doc);
}

std::vector<std::string> all_paths() {
  std::vector<std::string> paths;
  for (const KeyEntry& entry : schema()) paths.emplace_back(entry.path);
  return paths;
}

bool ends_in(std::string_view path, const std::string& name) {
  return path == name || path.ends_with("." + name);
}

std::string last_word(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

/// Names and sources are labels of a preset, told with it.
bool is_label(const PresetValue& value) {
  const KeyEntry* key = find_key(value.path);
  return key != nullptr && key->kind == KeyKind::text;
}

std::string cost_of(const StructuralModelEntry& model) {
  return model.relative_cost > 0.0 ? fmt::format("{:.2g}", model.relative_cost) : "no windows: milliseconds in all";
}

OrderedJson end_json(double value) {
  return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

}  // namespace

OrderedJson sections_json() {
  OrderedJson j = OrderedJson::object();
  for (const std::string& section : section_names()) j[section] = keys_of(section);
  j["levels.NAME"] = keys_of("levels.NAME");
  return j;
}

std::string sections_text() {
  Rows rows;
  for (const std::string& section : section_names()) {
    const std::vector<std::string> keys = keys_of(section);
    rows.push_back({fmt::format("[{}]", section), keys.empty() ? free_entry_text(section) : join_words(keys)});
    if (section == "levels") rows.push_back({"[levels.NAME]", join_words(keys_of("levels.NAME"))});
  }
  return table_text(rows, {false, false}) +
         "`standoff doc KEY` tells of a key, `standoff doc SECTION` of all its keys\n";
}

std::vector<std::string> keys_named(const std::string& name) {
  std::vector<std::string> paths;
  for (const KeyEntry& entry : schema())
    if (entry.path == name || entry.key() == name || ends_in(entry.section(), name)) paths.emplace_back(entry.path);
  return paths;
}

std::string free_entry_text(const std::string& name) {
  for (const FreeEntry& entry : free_entries)
    if (ends_in(entry.name, name)) return entry.doc;
  return "";
}

OrderedJson keys_json(const std::vector<std::string>& paths) {
  OrderedJson list = OrderedJson::array();
  for (const std::string& path : paths) {
    const KeyEntry& key = *find_key(path);
    OrderedJson j{{"key", path}, {"kind", kind_names[static_cast<std::size_t>(key.kind)]}, {"doc", key.doc}};
    if (!key.quantity.si.empty()) j["unit"] = key.quantity.si;
    if (!range_text(key).empty())
      j["range"] = {{"low", end_json(key.range.low)},
                    {"high", end_json(key.range.high)},
                    {"low_open", key.range.low_open},
                    {"high_open", key.range.high_open}};
    if (!key.words.empty()) j["words"] = key.word_list();
    j["default"] = key.fallback.empty() ? OrderedJson(nullptr) : OrderedJson(key.fallback);
    j["source"] = key.source;
    list.push_back(j);
  }
  return list;
}

std::string keys_text(const std::vector<std::string>& paths) {
  std::string text;
  for (const std::string& path : paths) text.append(text.empty() ? "" : "\n").append(describe_key(path));
  return text;
}

std::string unknown_key_text(const std::string& name) {
  const auto dot = name.rfind('.');
  const std::string section = dot == std::string::npos ? "" : name.substr(0, dot);
  std::string text = fmt::format("no key or section is called \"{}\"\n  ", name);
  if (const std::vector<std::string> keys = keys_of(section); !keys.empty())
    return text + did_you_mean(name.substr(dot + 1), keys, "keys of [" + section + "]");
  std::vector<std::string> known = all_paths();
  for (const KeyEntry& entry : schema()) known.emplace_back(entry.key());
  for (const std::string& each : section_names()) known.push_back(each), known.push_back(last_word(each));
  if (const std::string near = nearest_word(name, known); !near.empty()) text += "did you mean \"" + near + "\"?  ";
  return text + "sections: " + join_words(section_names());
}

OrderedJson effects_json() {
  OrderedJson list = OrderedJson::array();
  for (const Effect& rule : effect_rules())
    list.push_back({{"name", rule.name}, {"doc", rule.doc}, {"rule", rule.rule}, {"without", rule.without}});
  return list;
}

std::string effects_text() {
  Rows rows{{"effect", "what it is; when a scene calls for it; what a result misses without it"}};
  for (const Effect& rule : effect_rules()) {
    rows.push_back({rule.name, rule.doc});
    rows.push_back({"", std::string("  ") + rule.rule});
    rows.push_back({"", std::string("  without: ") + rule.without});
  }
  return table_text(rows, {false, false}) +
         "each case decides by its physics, see `standoff plan CASE`; [effects] of the case overrides: NAME = \"on\" "
         "or "
         "\"off\"\n";
}

OrderedJson presets_json() {
  OrderedJson list = OrderedJson::array();
  for (const Preset& preset : presets()) {
    OrderedJson values = OrderedJson::array();
    for (const PresetValue& value : preset.values)
      if (!is_label(value))
        values.push_back({{"key", value.path}, {"value", value_in_SI(value)}, {"source", source_of(preset, value)}});
    list.push_back({{"kind", preset.kind}, {"name", preset.name}, {"doc", preset.doc}, {"values", values}});
  }
  return list;
}

std::string presets_text() {
  std::string text;
  for (const Preset& preset : presets()) {
    Rows rows;
    for (const PresetValue& value : preset.values)
      if (!is_label(value)) rows.push_back({std::string(value.path), value_in_SI(value), source_of(preset, value)});
    text += fmt::format("{}{} \"{}\": {}\n", text.empty() ? "" : "\n", preset.kind, preset.name, preset.doc) +
            table_text(rows, {false, false, false});
  }
  return text;
}

OrderedJson models_json() {
  OrderedJson list = OrderedJson::array();
  for (const StructuralModelEntry& model : structural_models)
    list.push_back(
        {{"name", model.name},
         {"doc", model.doc},
         {"resolves", model.resolves},
         {"leaves_out", model.leaves_out},
         {"edges", model.edges},
         {"relative_cost", model.relative_cost > 0.0 ? OrderedJson(model.relative_cost) : OrderedJson(nullptr)},
         {"default", find_key("plate.model")->fallback == model.name}});
  return list;
}

std::string models_text() {
  std::string text;
  for (const StructuralModelEntry& model : structural_models)
    text += fmt::format("{}{}\n  {}\n  resolves    {}\n  leaves out  {}\n  edges       {}\n  cost        {}\n",
                        model.name, find_key("plate.model")->fallback == model.name ? " (default)" : "", model.doc,
                        model.resolves, model.leaves_out, model.edges, cost_of(model));
  return text +
         "choose with plate.model = \"NAME\" or --structure NAME; cost: processor time of the windows of dry_150mm "
         "--level "
         "coarse over that of the default, exchange apart (tests/validation/model_costs.py; a pipe: over that of the "
         "plate "
         "it is rolled from)\n"
         "--structure replay:TAPE plays a recorded motion in place of a model: it computes nothing and costs the "
         "exchange\n";
}

}  // namespace standoff::launch
