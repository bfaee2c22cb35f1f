#include "coupling/case/resolved_text.hpp"

#include <algorithm>

#include "coupling/base/state_hash.hpp"
#include "coupling/case/references.hpp"

namespace standoff {
namespace {

/// Keys that were turned into others, and keys of things the scene does not hold, are not repeated.
bool is_written(const CaseSpec& spec, const Settings& settings, std::string_view path) {
  if (!settings.has(std::string(path)) || path == "domain.size" || path.ends_with(".preset")) return false;
  if (path.starts_with("plate.pipe.") && !spec.plate.is_pipe()) return false;
  if (path == "plate.size" && spec.plate.is_pipe()) return false;  // follows from plate.pipe
  if (path.starts_with("charge.") && !spec.charge.present) return false;
  if (path.starts_with("cell.") && spec.soil.kind == SoilKind::none) return false;
  return !path.starts_with("soil.") || path == "soil.kind" || spec.soil.kind != SoilKind::none;
}

std::string with_origin(std::string line, std::string origin) {
  std::replace_if(
      origin.begin(), origin.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, '?');
  line.resize(std::max<std::size_t>(line.size() + 2, 52), ' ');
  return line + "# " + origin + "\n";
}

std::string key_text(std::string_view key, const std::string& value, const std::string& origin) {
  return with_origin(std::string(key) + " = " + value, origin);
}

/// The other levels as they were stated; the chosen one as it was used, so that reading it back changes nothing.
std::string level_text(const CaseSpec& spec, const Settings& settings) {
  std::string text;
  for (const std::string& level : spec.levels) {
    text += "\n[levels." + (level.find_first_of(". \"'#[]=") == std::string::npos ? level : in_quotes(level)) + "]\n";
    for (const LevelKey& key : level_keys()) {
      const Setting* stated = settings.find("levels." + level + "." + std::string(key.key));
      if (!stated) continue;
      const std::string sets(key.sets);
      const Setting* used = level == spec.level && settings.has(sets) ? settings.find(sets) : stated;
      text += key_text(key.key, toml_text(used->value, *find_key(key.sets)), stated->origin);
    }
  }
  return text;
}

std::string effect_text(const CaseSpec& spec, const Settings& settings) {
  std::string text = "\n[effects]\n";
  for (const EffectDecision& effect : spec.effects) {
    const Setting* stated = settings.find("effects." + effect.name);
    if (stated)
      text += key_text(effect.name, in_quotes(settings.word("effects." + effect.name)), stated->origin);
    else
      text += with_origin("# " + effect.name + " is " + (effect.on ? "on" : "off"), effect.reason);
  }
  return text;
}

}  // namespace

std::string resolved_text(const CaseSpec& spec, const Settings& settings) {
  std::string text = "# " + (spec.name.empty() ? "case" : spec.name) +
                     ", resolved: every value in SI with its origin. This file is a case.\n";
  std::string_view section;
  for (const KeyEntry& entry : schema()) {
    if (!is_written(spec, settings, entry.path)) continue;
    if (entry.section() != section) {
      section = entry.section();
      text += "\n[" + std::string(section) + "]\n";
    }
    const Setting& setting = *settings.find(std::string(entry.path));
    text += key_text(entry.key(), toml_text(setting.value, entry), setting.origin);
  }
  return text + effect_text(spec, settings) + level_text(spec, settings) + reference_text(spec.references);
}

std::string case_fingerprint(const CaseSpec& spec, const Settings& settings) {
  StateHash hash;
  for (const KeyEntry& entry : schema()) {
    const bool words = entry.section() == "case" || entry.path == "plate.material.source";
    if (words || !is_written(spec, settings, entry.path)) continue;
    hash.add(entry.path);
    hash.add(toml_text(settings.find(std::string(entry.path))->value, entry));
  }
  for (const EffectDecision& effect : spec.effects) {
    hash.add(effect.name);
    hash.add(std::uint64_t{effect.on});
  }
  return hash.hex();
}

}  // namespace standoff
