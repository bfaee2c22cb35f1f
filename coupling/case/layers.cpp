#include "coupling/case/layers.hpp"

#include <algorithm>
#include <filesystem>

#include "coupling/case/effects/registry.hpp"
#include "coupling/case/near_word.hpp"
#include "coupling/case/references.hpp"

namespace standoff {
namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// Writes the statements of one source (a file, a --set) into the settings.
class Statements {
 public:
  Statements(Layers& layers, Diagnostics& diagnostics, int rank, std::string origin)
      : layers_(layers),
        settings_(layers.settings),
        diagnostics_(diagnostics),
        rank_(rank),
        origin_(std::move(origin)) {}

  void read_root(const Node& root) {
    for (const Node::Member& member : *root.table()) {
      if (member.name == "effects")
        read_effects(member.node);
      else if (member.name == "levels")
        read_levels(member.node);
      else if (member.name == "references")
        read_references(member.node, layers_.references, diagnostics_);
      else if (contains(section_names(), member.name))
        read_section(member.name, member);
      else
        unknown_section(member);
    }
  }

 private:
  void read_section(const std::string& section, const Node::Member& from) {
    if (from.place.line > 0) settings_.sections[section] = from.place;
    if (!is_table(from.node, section)) return;
    for (const Node::Member& member : *from.node.table()) {
      const std::string path = section + "." + member.name;
      if (path == "case.use") continue;  // followed before
      if (contains(section_names(), path))
        read_table_or_preset(path, member);
      else if (const KeyEntry* entry = find_key(path))
        read_value(path, *entry, member.node);
      else
        unknown_key(member, section, keys_of(section));
    }
  }

  /// explosive = "c4" is short for explosive = { preset = "c4" }, and replaces a table given before.
  void read_table_or_preset(const std::string& path, const Node::Member& member) {
    const bool whole = !member.node.table() || member.node.find("preset");
    if (whole) settings_.forget_section(path);
    if (member.node.table()) return read_section(path, member);
    const KeyEntry* entry = find_key(path + ".preset");
    if (member.node.text()) {
      // The message names the key as written, not its long form.
      KeyEntry shown = *entry;
      shown.path = path;
      return read_value(std::string(entry->path), shown, member.node);
    }
    settings_.mark_wrong(std::string(entry->path));
    const std::vector<std::string> words = entry->word_list();
    diagnostics_.error(member.node.place, member.name + " = " + member.node.shown() + " is neither a name nor a table",
                       "names: " + join_words(words) + "; keys of the table: " + join_words(keys_of(path)));
  }

  void read_value(const std::string& path, const KeyEntry& entry, const Node& node) {
    const std::optional<Value> value = check_value(node, entry, diagnostics_);
    if (!value) return settings_.mark_wrong(path);
    settings_.add(path, {*value, origin_at(node.place), node.place, rank_});
  }

  void read_effects(const Node& node) {
    if (!is_table(node, "effects")) return;
    for (const Node::Member& member : *node.table()) {
      if (!contains(effect_names(), member.name)) {
        diagnostics_.error(member.place, "unknown effect " + in_quotes(member.name),
                           did_you_mean(member.name, effect_names(), "effects"));
        continue;
      }
      // Views into text that outlives the check.
      const std::string path = "effects." + member.name;
      const KeyEntry entry{
          path, KeyKind::choice, quantity::none, {}, "on|off", "", "Overrides the rule of this effect."};
      read_value(path, entry, member.node);
    }
  }

  void read_levels(const Node& node) {
    if (!is_table(node, "levels")) return;
    for (const Node::Member& level : *node.table()) {
      if (!is_table(level.node, "levels." + level.name)) continue;
      if (!contains(settings_.levels, level.name)) settings_.levels.push_back(level.name);
      for (const Node::Member& member : *level.node.table()) {
        const auto known = std::find_if(level_keys().begin(), level_keys().end(),
                                        [&](const LevelKey& key) { return key.key == member.name; });
        if (known == level_keys().end()) {
          unknown_key(member, "levels." + level.name, keys_of("levels.NAME"));
          continue;
        }
        const std::string path = "levels." + level.name + "." + member.name;
        KeyEntry entry = *find_key(known->sets);
        entry.path = path;
        read_value(path, entry, member.node);
      }
    }
  }

  bool is_table(const Node& node, const std::string& section) {
    if (node.table()) return true;
    diagnostics_.error(node.place, section + " = " + node.shown() + " is not a table; write [" + section + "]");
    return false;
  }

  void unknown_key(const Node::Member& member, const std::string& section, const std::vector<std::string>& keys) {
    std::string hint = did_you_mean(member.name, keys, "keys here");
    if (nearest_word(member.name, keys).empty())
      if (const std::string home = home_of(member.name); !home.empty()) hint = home + "  " + hint;
    diagnostics_.error(member.place, "unknown key " + in_quotes(member.name) + " in [" + section + "]", hint);
  }

  void unknown_section(const Node::Member& member) {
    const std::vector<std::string> sections = section_names();
    const std::string home = home_of(member.name);
    const bool table = member.node.table() != nullptr;
    diagnostics_.error(member.place,
                       (table ? "unknown section [" + member.name + "]"
                              : "unknown key " + in_quotes(member.name) + " outside of any section"),
                       (home.empty() ? "" : home + "  ") + did_you_mean(member.name, sections, "sections"));
  }

  /// `"until" belongs in [run]`
  static std::string home_of(const std::string& key) {
    for (const KeyEntry& entry : schema())
      if (entry.key() == key) return in_quotes(key) + " belongs in [" + std::string(entry.section()) + "]";
    return "";
  }

  std::string origin_at(const Place& place) const {
    return place.line == 0 ? origin_ : origin_ + ":" + std::to_string(place.line);
  }

  Layers& layers_;
  Settings& settings_;
  Diagnostics& diagnostics_;
  int rank_;
  std::string origin_;
};

/// Path as a person would write it from here.
std::string shown_path(const fs::path& path) {
  std::error_code ignored;
  const fs::path near = fs::relative(path, ignored);
  const bool below = !near.empty() && *near.begin() != "..";
  return (below ? near : path.lexically_normal()).string();
}

/// Reads a file after everything it uses.
class FileReader {
 public:
  FileReader(Layers& layers, Diagnostics& diagnostics) : layers_(layers), diagnostics_(diagnostics) {}

  bool read(const fs::path& path) {
    const std::string shown = shown_path(path);
    const std::optional<Node> root = read_document(path.string(), shown, diagnostics_);
    if (!root) return false;
    open_.push_back(fs::weakly_canonical(path));
    if (const Node* about = root->find("case"); about && about->table())
      if (const Node* use = about->find("use")) read_used(*use, path);
    open_.pop_back();
    Statements(layers_, diagnostics_, next_rank_++, shown).read_root(*root);
    return true;
  }

  /// reference.toml holds references and nothing else.
  void read_reference_file(const fs::path& path) {
    const std::string shown = shown_path(path);
    const std::optional<Node> root = read_document(path.string(), shown, diagnostics_);
    if (!root) return;
    for (const Node::Member& member : *root->table())
      if (member.name == "references")
        read_references(member.node, layers_.references, diagnostics_);
      else
        diagnostics_.error(member.place, "unknown section [" + member.name + "]",
                           "this file holds [[references]] only");
  }

 private:
  void read_used(const Node& use, const fs::path& user) {
    const Node::Array* list = use.array();
    if (!list)
      return diagnostics_.error(use.place, "use = " + use.shown() + " is not a list; write use = [\"common/c4.toml\"]");
    for (const Node& element : *list) {
      if (!element.text()) {
        diagnostics_.error(element.place, "use: " + element.shown() + " is not the path of a file");
        continue;
      }
      const std::optional<fs::path> found = locate(*element.text(), user, element.place);
      if (!found || !free_of_cycles(*found, element)) continue;
      read(*found);
    }
  }

  /// Beside the file that uses it, else in a folder above that holds `common`: the folder of all cases.
  std::optional<fs::path> locate(const std::string& name, const fs::path& user, const Place& place) {
    const fs::path beside = user.parent_path() / name;
    std::error_code ignored;
    if (fs::is_regular_file(beside, ignored)) return beside.lexically_normal();
    std::string tried = shown_path(beside);
    for (fs::path above = fs::absolute(user).parent_path(); !above.empty(); above = above.parent_path()) {
      if (fs::is_directory(above / "common", ignored)) {
        const fs::path candidate = above / name;
        if (fs::is_regular_file(candidate, ignored)) return candidate;
        tried += ", " + shown_path(candidate);
      }
      if (above == above.parent_path()) break;
    }
    diagnostics_.error(place, "use: there is no file " + in_quotes(name), "looked for " + tried);
    return std::nullopt;
  }

  bool free_of_cycles(const fs::path& path, const Node& element) {
    const fs::path real = fs::weakly_canonical(path);
    const auto begin = std::find(open_.begin(), open_.end(), real);
    if (begin == open_.end()) return true;
    std::string circle;
    for (auto it = begin; it != open_.end(); ++it) circle += it->filename().string() + " -> ";
    diagnostics_.error(element.place, "use: " + element.shown() + " uses itself", circle + real.filename().string());
    return false;
  }

  Layers& layers_;
  Diagnostics& diagnostics_;
  std::vector<fs::path> open_;  // the files being read, outermost first
  int next_rank_ = rank::file;
};

Node nested(const std::vector<std::string>& keys, std::size_t at, Node value, const Place& place) {
  if (at == keys.size()) return value;
  Node::Table table;
  table.push_back({keys[at], place, nested(keys, at + 1, std::move(value), place)});
  return {std::move(table), place};
}

void read_set(Layers& layers, Diagnostics& diagnostics, const std::string& key, const std::string& text, int rank) {
  const Place place{"--set " + key + "=" + text};
  std::vector<std::string> keys{""};
  for (const char c : key)
    if (c == '.')
      keys.emplace_back();
    else if (c != ' ')
      keys.back() += c;
  if (contains(keys, "") || text.empty())
    return diagnostics.error(place, "KEY=VALUE is needed, for example --set run.until=\"2 ms\"");
  if (key == "case.use" || keys.front() == "references")
    return diagnostics.error(place, in_quotes(key) + " can only be stated in a file");
  const KeyEntry* entry = find_key(key);
  Node value = read_typed_value(text, place);
  if (entry && entry->kind == KeyKind::text && !value.text()) value.value = text;
  Statements(layers, diagnostics, rank, "--set").read_root(nested(keys, 0, std::move(value), place));
}

void read_options(Layers& layers, Diagnostics& diagnostics, const CaseOverrides& overrides) {
  int rank = rank::set;
  for (const auto& [key, text] : overrides.set) read_set(layers, diagnostics, key, text, rank++);
  const auto option = [&](const std::string& name, const std::string& path, const std::string& text) {
    if (text.empty()) return;
    const Place place{name + " " + text};
    const std::optional<Value> value = check_value(read_typed_value(text, place), *find_key(path), diagnostics);
    if (value) layers.settings.add(path, {*value, name, place, rank::option});
  };
  option("--structure", "plate.model", overrides.structure_model);
  option("--seed", "run.seed", overrides.seed);
}

void choose_level(Layers& layers, Diagnostics& diagnostics, const std::string& wanted) {
  Settings& settings = layers.settings;
  const std::vector<std::string>& levels = settings.levels;
  std::string name = wanted.empty() ? settings.word("case.level") : wanted;
  std::string origin = wanted.empty() && settings.find("case.level") ? settings.find("case.level")->origin : "--level";
  if (!name.empty() && !contains(levels, name)) {
    const Place place = wanted.empty() ? settings.blame({"case.level"}) : Place{"--level " + wanted};
    return diagnostics.error(place, "unknown level " + in_quotes(name),
                             levels.empty() ? "this case has no levels" : did_you_mean(name, levels, "levels here"));
  }
  if (name.empty() && levels.empty()) return;
  if (name.empty()) name = contains(levels, "coarse") ? "coarse" : levels.front(), origin = "default";
  layers.level = name;
  settings.add("case.level", {name, origin, {}, rank::option});
  for (const LevelKey& key : level_keys()) {
    const std::string path = "levels." + name + "." + std::string(key.key);
    if (settings.is_wrong(path)) settings.mark_wrong(std::string(key.sets));
    if (const Setting* stated = settings.find(path))
      settings.add(std::string(key.sets),
                   {stated->value, "level " + name + ", " + stated->origin, stated->place, rank::level});
  }
}

}  // namespace

Layers read_layers(const std::string& case_path, const CaseOverrides& overrides, Diagnostics& diagnostics) {
  Layers layers;
  std::error_code ignored;
  fs::path file(case_path);
  if (fs::is_directory(file, ignored)) file /= "case.toml";
  file = file.lexically_normal();
  layers.folder = file.has_parent_path() ? file.parent_path().string() : ".";
  const bool ordinary = file.filename() == "case.toml";
  layers.name = ordinary ? fs::absolute(file).parent_path().filename().string() : file.stem().string();
  layers.settings.main_file = {shown_path(file), 1, 1};
  FileReader reader(layers, diagnostics);
  layers.readable = reader.read(file);
  const fs::path beside = file.parent_path() / "reference.toml";
  if (ordinary && fs::is_regular_file(beside, ignored)) reader.read_reference_file(beside);
  read_options(layers, diagnostics, overrides);
  if (layers.readable) choose_level(layers, diagnostics, overrides.level);
  return layers;
}

}  // namespace standoff
