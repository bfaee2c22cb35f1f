#include "coupling/case/document.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "coupling/case/units.hpp"

namespace standoff {
namespace {

Place place_of(const toml::source_region& source, const std::string& file) {
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

Node convert(const toml::node& from, const std::string& file) {
  Node node;
  node.place = place_of(from.source(), file);
  if (const auto* table = from.as_table()) {
    Node::Table members;
    for (const auto& [key, value] : *table)
      members.push_back({std::string(key.str()), place_of(key.source(), file), convert(value, file)});
    // The parser sorts by name; a reader of messages and levels expects the order of the file.
    std::stable_sort(members.begin(), members.end(), [](const Node::Member& a, const Node::Member& b) {
      return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
    });
    node.value = std::move(members);
  } else if (const auto* array = from.as_array()) {
    Node::Array elements;
    for (const toml::node& element : *array) elements.push_back(convert(element, file));
    node.value = std::move(elements);
  } else if (const auto* text = from.as_string()) {
    node.value = text->get();
  } else if (const auto* integer = from.as_integer()) {
    node.value = static_cast<long long>(integer->get());
  } else if (const auto* number = from.as_floating_point()) {
    node.value = number->get();
  } else if (const auto* flag = from.as_boolean()) {
    node.value = flag->get();
  } else {
    node.value = Node::Other{};
  }
  return node;
}

void set_place(Node& node, const Place& place) {
  node.place = place;
  if (auto* array = std::get_if<Node::Array>(&node.value))
    for (Node& element : *array) set_place(element, place);
  if (auto* table = std::get_if<Node::Table>(&node.value))
    for (Node::Member& member : *table) member.place = place, set_place(member.node, place);
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

}  // namespace

const Node* Node::find(const std::string& name) const {
  if (const Table* members = table())
    for (const Member& member : *members)
      if (member.name == name) return &member.node;
  return nullptr;
}

std::string Node::shown() const {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const long long* integer = std::get_if<long long>(&value)) return std::to_string(*integer);
  if (const double* number = std::get_if<double>(&value)) return exact_text(*number);
  if (const std::string* words = text()) return in_quotes(*words);
  if (table()) return "{...}";
  if (std::holds_alternative<Other>(value)) return "a date or time";
  std::string list = "[";
  for (const Node& element : *array()) list += (list.size() > 1 ? ", " : "") + element.shown();
  return list + "]";
}

std::optional<Node> read_document(const std::string& path, const std::string& shown_path, Diagnostics& diagnostics) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (!file || !(content << file.rdbuf())) {
    diagnostics.error({shown_path, 1, 1}, "cannot read this file",
                      "a case is a folder that holds case.toml, or a file");
    return std::nullopt;
  }
  try {
    const toml::table root = toml::parse(content.str(), shown_path);
    return convert(root, shown_path);
  } catch (const toml::parse_error& problem) {
    diagnostics.error(place_of(problem.source(), shown_path), "not valid TOML: " + std::string(problem.description()));
    return std::nullopt;
  }
}

Node read_typed_value(const std::string& text, const Place& place) {
  Node node;
  try {
    const toml::table root = toml::parse("value = " + text + "\n");
    if (root.size() == 1) {
      node = convert(*root.get("value"), "");
      set_place(node, place);
      return node;
    }
  } catch (const toml::parse_error&) {  // words and values with a unit need no quotes on a command line
  }
  const std::string plain = trimmed(text);
  node.place = place;
  node.value = plain;
  if (plain.size() >= 2 && plain.front() == '[' && plain.back() == ']') {
    Node::Array elements;
    std::istringstream list(plain.substr(1, plain.size() - 2));
    for (std::string element; std::getline(list, element, ',');)
      elements.push_back(read_typed_value(trimmed(element), place));
    node.value = std::move(elements);
  }
  return node;
}

std::string in_quotes(const std::string& text) {
  static constexpr char digits[] = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\', out += c;
    } else if (code < 0x20 || code == 0x7F) {
      out += "\\u00", out += digits[code >> 4], out += digits[code & 15];
    } else {
      out += c;
    }
  }
  return out + "\"";
}

}  // namespace standoff
