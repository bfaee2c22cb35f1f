#pragma once
// Every key a case may hold, once: what it is, what it may be, what it is when nobody states it, what it means and
// where the figure comes from. Reading, range errors, "did you mean", key lists, resolved cases and `standoff doc` all
// come from this table.
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/case/units.hpp"

namespace standoff {

enum class KeyKind {
  quantity,    // "3.4 mm"
  number,      // 0.3
  count,       // 10_000
  flag,        // true, false
  text,        // "any words"
  choice,      // one of KeyEntry::words
  quantities,  // three quantities: ["406 mm", "406 mm", "3.4 mm"]
  counts,      // three counts: [10, 10, 1]
  list,        // any number of numbers or quantities: [0, 0.1], ["410 MPa", "600 MPa"]
};

/// Allowed values in SI; the ends belong to it unless open.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;

  bool holds(double value) const {
    return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
  }
};

struct KeyEntry {
  std::string_view path;  // "plate.size": section and key
  KeyKind kind = KeyKind::text;
  Quantity quantity = quantity::none;
  Range range;
  std::string_view words;     // the choices, or words taken beside a number: "auto|step"
  std::string_view fallback;  // default as in a case file; "" = none, or derived by a rule told in `doc`
  std::string_view doc;       // one sentence, or two
  std::string_view source = "";

  std::string_view section() const { return path.substr(0, path.rfind('.')); }
  std::string_view key() const { return path.substr(path.rfind('.') + 1); }
  std::vector<std::string> word_list() const;
};

/// All keys in the order they are written into resolved cases.
std::span<const KeyEntry> schema();
const KeyEntry* find_key(std::string_view path);
/// Sections a case may hold, `effects`, `levels` and `references` included.
std::vector<std::string> section_names();
/// Keys of a section, without the section.
std::vector<std::string> keys_of(std::string_view section);
/// Key of [levels.NAME] and the key it sets: {"charge", "charge.particles"}.
struct LevelKey {
  std::string_view key, sets;
};
std::span<const LevelKey> level_keys();

/// "0 < packing <= 0.74", "mass > 0 kg"
std::string range_text(const KeyEntry& entry);
/// What `standoff doc KEY` prints; KEY is "plate.size" or the bare key. Empty for an unknown key.
std::string describe_key(std::string_view key);

}  // namespace standoff
