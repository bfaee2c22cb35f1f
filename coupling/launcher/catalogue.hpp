#pragma once
// What exists: keys, effects, presets and structural models, as JSON for programs and as text for people. Read from the
// tables that the case reader itself uses, so nothing here can be out of date.
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace standoff::launch {

using OrderedJson = nlohmann::ordered_json;

/// All sections with their keys.
OrderedJson sections_json();
std::string sections_text();

/// Keys that `name` stands for: "plate.size", the bare "size", or all of a section "plate", "material". Empty if there
/// is none.
std::vector<std::string> keys_named(const std::string& name);
OrderedJson keys_json(const std::vector<std::string>& paths);
std::string keys_text(const std::vector<std::string>& paths);
/// One line on what is no row of the table of keys: "effects", "levels", "references", "use". Empty for anything else.
std::string free_entry_text(const std::string& name);
/// `no key "sizze"` with what may have been meant.
std::string unknown_key_text(const std::string& name);

OrderedJson effects_json();
std::string effects_text();

/// Values in SI; the source of a value is that of its key, else that of its preset.
OrderedJson presets_json();
std::string presets_text();

OrderedJson models_json();
std::string models_text();

}  // namespace standoff::launch
