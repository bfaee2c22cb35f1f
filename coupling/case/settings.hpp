#pragma once
// What was stated for each key, by whom, and which statement counts: preset < use < case < level < --set < option.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "coupling/case/diagnostics.hpp"
#include "coupling/case/value.hpp"

namespace standoff {

/// Order of precedence. Files count up from `file` in the order they are read: an included file before its includer.
namespace rank {
inline constexpr int fallback = 0, derived = 1, preset = 2, file = 10, level = 1'000'000, set = 2'000'000,
                     option = 3'000'000;
}

struct Setting {
  Value value;
  std::string origin;  // "case.toml:12", "preset c4", "default", "level coarse", "--set", "derived: ..."
  Place place;         // empty file for built-in values
  int rank = rank::fallback;
};

class Settings {
 public:
  /// Later additions of the same rank win.
  void add(const std::string& path, Setting setting) {
    Setting& now = stated_[path];
    if (now.origin.empty() || setting.rank >= now.rank) now = std::move(setting);
  }
  /// A key whose last statement was wrong: nothing that depends on it is checked.
  void mark_wrong(const std::string& path) { wrong_.insert(path); }
  bool is_wrong(const std::string& path) const { return wrong_.contains(path); }

  /// A whole value replaces a table given before: explosive = "c4" after [charge.explosive].
  void forget_section(const std::string& section) {
    std::erase_if(stated_, [&](const auto& item) { return item.first.starts_with(section + "."); });
    std::erase_if(wrong_, [&](const std::string& path) { return path.starts_with(section + "."); });
  }

  void forget(const std::string& path) { stated_.erase(path); }

  const Setting* find(const std::string& path) const {
    const auto it = stated_.find(path);
    return it == stated_.end() ? nullptr : &it->second;
  }
  bool has(const std::string& path) const { return stated_.contains(path); }
  /// Stated or tried to be stated anywhere below `section`.
  bool has_section(const std::string& section) const {
    const auto below = [&](const std::string& path) { return path.starts_with(section + "."); };
    for (const auto& [path, setting] : stated_)
      if (below(path)) return true;
    for (const std::string& path : wrong_)
      if (below(path)) return true;
    return false;
  }
  const std::map<std::string, Setting>& all() const { return stated_; }

  // The value of a key that is known to be there.
  double number(const std::string& path) const { return std::get<double>(at(path).value); }
  long long count(const std::string& path) const { return std::get<long long>(at(path).value); }
  bool flag(const std::string& path) const { return std::get<bool>(at(path).value); }
  Triple triple(const std::string& path) const { return std::get<Triple>(at(path).value); }
  CountTriple counts(const std::string& path) const { return std::get<CountTriple>(at(path).value); }
  /// The word, or "" if the key holds a number or is absent.
  std::string word(const std::string& path) const {
    const Setting* setting = find(path);
    const std::string* text = setting ? std::get_if<std::string>(&setting->value) : nullptr;
    return text ? *text : "";
  }

  /// Where to point for a mistake that involves several keys: at the one stated with the highest rank.
  Place blame(const std::vector<std::string>& paths) const {
    const Setting* best = nullptr;
    for (const std::string& path : paths)
      if (const Setting* s = find(path); s && !s->place.file.empty() && (!best || s->rank > best->rank)) best = s;
    return best ? best->place : section_place(paths.empty() ? "" : paths.front());
  }
  /// Position of the [section] of `path`, or the top of the case file.
  Place section_place(const std::string& path) const {
    const auto it = sections.find(path.substr(0, path.find('.')));
    return it == sections.end() ? main_file : it->second;
  }

  std::map<std::string, Place> sections;  // where [charge], [plate] ... begin
  Place main_file;                        // the case file, line 1
  std::vector<std::string> levels;        // names in the order of the files

 private:
  const Setting& at(const std::string& path) const { return stated_.at(path); }

  std::map<std::string, Setting> stated_;
  std::set<std::string> wrong_;
};

}  // namespace standoff
