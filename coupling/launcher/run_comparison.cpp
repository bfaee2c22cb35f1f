#include "coupling/launcher/run_comparison.hpp"

#include <cmath>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "coupling/base/stop.hpp"
#include "coupling/launcher/run_follower.hpp"
#include "coupling/launcher/text_format.hpp"

namespace standoff::launch {
namespace {

using Rows = std::vector<std::vector<std::string>>;
using Words = std::map<std::string, std::string>;

void flatten(const Node& node, const std::string& path, Words& values) {
  if (const Node::Table* table = node.table()) {
    for (const Node::Member& member : *table)
      if (!path.empty() || (member.name != "levels" && member.name != "references"))
        flatten(member.node, path.empty() ? member.name : path + "." + member.name, values);
  } else {
    values[path] = node.shown();
  }
}

/// Numbers below `j` by dotted key, in the order of the record.
void collect_numbers(const OrderedJson& j, const std::string& path, std::vector<std::pair<std::string, double>>& into) {
  if (j.is_number()) into.emplace_back(path, j.get<double>());
  if (j.is_object())
    for (const auto& [key, value] : j.items()) collect_numbers(value, path.empty() ? key : path + "." + key, into);
}

OrderedJson compared_numbers(const OrderedJson& a, const OrderedJson& b, const char* group) {
  std::vector<std::pair<std::string, double>> left, right;
  if (a.contains(group)) collect_numbers(a[group], "", left);
  if (b.contains(group)) collect_numbers(b[group], "", right);
  const std::map<std::string, double> in_a(left.begin(), left.end()), in_b(right.begin(), right.end());
  for (const auto& each : right)
    if (!in_a.contains(each.first)) left.push_back(each);
  OrderedJson list = OrderedJson::array();
  for (const auto& [key, ignored] : left) {
    OrderedJson row{{"key", key}, {"a", nullptr}, {"b", nullptr}, {"difference", nullptr}, {"relative", nullptr}};
    const auto x = in_a.find(key), y = in_b.find(key);
    if (x != in_a.end()) row["a"] = x->second;
    if (y != in_b.end()) row["b"] = y->second;
    if (x != in_a.end() && y != in_b.end()) {
      row["difference"] = y->second - x->second;
      if (x->second != 0.0) row["relative"] = (y->second - x->second) / std::abs(x->second);
    }
    list.push_back(row);
  }
  return list;
}

OrderedJson compared_words(const Words& a, const Words& b) {
  std::set<std::string> keys;
  for (const Words* words : {&a, &b})
    for (const auto& [key, ignored] : *words) keys.insert(key);
  OrderedJson list = OrderedJson::array();
  for (const std::string& key : keys) {
    const auto x = a.find(key), y = b.find(key);
    if (x != a.end() && y != b.end() && x->second == y->second) continue;
    OrderedJson row{{"key", key}, {"a", nullptr}, {"b", nullptr}};
    if (x != a.end()) row["a"] = x->second;
    if (y != b.end()) row["b"] = y->second;
    list.push_back(row);
  }
  return list;
}

void collect_words(const OrderedJson& j, const std::string& path, Words& into) {
  if (j.is_object())
    for (const auto& [key, value] : j.items()) collect_words(value, path.empty() ? key : path + "." + key, into);
  else
    into[path] = j.is_string() ? j.get<std::string>() : j.dump();
}

/// Which effects were on belongs to the inputs: rules decide them where the case does not.
Words inputs_of(const ComparedRun& run) {
  Words inputs = run.inputs;
  if (run.record.contains("effects"))
    for (const OrderedJson& effect : run.record["effects"])
      if (effect.contains("name") && effect.contains("on"))
        inputs["effects." + effect["name"].get<std::string>()] = effect["on"] == true ? "on" : "off";
  return inputs;
}

Words provenance_of(const ComparedRun& run) {
  Words words;
  if (run.record.contains("provenance")) collect_words(run.record["provenance"], "", words);
  return words;
}

std::string text_of(const OrderedJson& value) {
  return value.is_null() ? "-" : value.is_string() ? value.get<std::string>() : value.dump();
}

std::string words_text(const OrderedJson& list, const std::string& title) {
  Rows rows;
  for (const OrderedJson& row : list) rows.push_back({row["key"], text_of(row["a"]), text_of(row["b"])});
  return title + (rows.empty() ? ": no difference\n" : "\n" + table_text(rows, {false, false, false}));
}

/// Wall-clock and simulated seconds span nine decades in one table: each in the unit that suits it.
std::string number_text(const std::string& key, double value) {
  const bool seconds = key.ends_with("_s") && !key.ends_with("_per_s") && !key.ends_with("_Pa_s");
  if (seconds || key.starts_with("particle.stages.") || key.starts_with("structure.stages.") ||
      key.starts_with("cpu_s."))
    return duration_text(value);
  const bool whole = value == std::floor(value) && std::abs(value) < 1e15;
  return whole && value_text(key, 1.0) == "1" ? with_separators(static_cast<long>(value)) : value_text(key, value);
}

std::string numbers_text(const OrderedJson& list, const std::string& title) {
  Rows rows;
  for (const OrderedJson& row : list) {
    const std::string key = row["key"];
    const auto shown = [&](const char* name) {
      return row[name].is_number() ? number_text(key, row[name].get<double>()) : "-";
    };
    const std::string relative =
        row["relative"].is_number() ? fmt::format("{:+.3g} %", 100.0 * row["relative"].get<double>()) : "";
    const bool equal = row["difference"].is_number() && row["difference"].get<double>() == 0.0;
    rows.push_back({key, shown("a"), shown("b"), equal ? "equal" : shown("difference"), equal ? "" : relative});
  }
  if (rows.empty()) return title + ": none\n";
  return title + "\n" + table_text(rows, {false, true, true, true, true});
}

OrderedJson only_different(const OrderedJson& list) {
  OrderedJson kept = OrderedJson::array();
  for (const OrderedJson& row : list)
    if (!row["difference"].is_number() || row["difference"].get<double>() != 0.0) kept.push_back(row);
  return kept;
}

}  // namespace

std::map<std::string, std::string> flat_inputs(const Node& document) {
  Words values;
  flatten(document, "", values);
  return values;
}

ComparedRun compared_run(const std::string& folder) {
  ComparedRun run{folder, read_record(folder), {}};
  const std::string path = folder + "/case.resolved.toml";
  if (!std::filesystem::exists(path)) return run;
  Diagnostics diagnostics;
  if (const auto document = read_document(path, path, diagnostics)) run.inputs = flat_inputs(*document);
  return run;
}

OrderedJson comparison_json(const ComparedRun& a, const ComparedRun& b) {
  OrderedJson j;
  j["runs"] = OrderedJson::array();
  for (const ComparedRun* run : {&a, &b})
    j["runs"].push_back({{"folder", run->folder},
                         {"case", run->record.value("case", "")},
                         {"level", run->record.value("level", "")},
                         {"status", run->record.value("status", "")}});
  j["inputs"] = compared_words(inputs_of(a), inputs_of(b));
  for (const char* group : {"results", "relaxation", "conservation", "counts", "timing"})
    j[group] = compared_numbers(a.record, b.record, group);
  const Words left = provenance_of(a), right = provenance_of(b);
  j["provenance"] = compared_words(left, right);
  const auto x = left.find("state_hash"), y = right.find("state_hash");
  j["same_bits"] = x != left.end() && y != right.end() && x->second == y->second;
  return j;
}

std::string comparison_text(const OrderedJson& j) {
  std::string text;
  for (const OrderedJson& run : j["runs"])
    text +=
        fmt::format("{}  {}: {} {} ({})\n", text.empty() ? "a" : "b", run["folder"].get<std::string>(),
                    run["case"].get<std::string>(), run["level"].get<std::string>(), run["status"].get<std::string>());
  std::vector<std::string> parts{words_text(j["inputs"], "inputs that differ"),
                                 numbers_text(j["results"], "results: a, b, b - a")};
  for (const char* group : {"relaxation", "conservation", "counts"})
    if (const OrderedJson rows = only_different(j[group]); !rows.empty())
      parts.push_back(numbers_text(rows, std::string(group) + ", where different"));
  parts.push_back(numbers_text(j["timing"], "timing: a, b, b - a"));
  parts.push_back(words_text(j["provenance"], "provenance that differs"));
  for (const std::string& part : parts) text.append("\n").append(part);
  return text + (j["same_bits"] == true ? "\nboth ended in the same state, bit for bit\n" : "");
}

}  // namespace standoff::launch
