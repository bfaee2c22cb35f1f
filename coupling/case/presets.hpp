#pragma once
// Named sets of constants: explosives, plate materials, base parameters of sand. They rank below everything a case
// states.
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace standoff {

struct PresetValue {
  std::string_view path, text;   // key and value, as a case file would say it
  std::string_view source = "";  // where this value comes from, if not from what the preset's doc cites
};

struct Preset {
  std::string_view kind;  // "explosive", "material", "soil"
  std::string_view name, doc;
  std::vector<PresetValue> values;
};

/// For `standoff presets`.
const std::vector<Preset>& presets();
/// Null if there is none.
const Preset* find_preset(std::string_view kind, std::string_view name);

}  // namespace standoff
