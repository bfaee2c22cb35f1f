#include "coupling/case/value.hpp"

#include <cmath>
#include <stdexcept>

#include "coupling/case/near_word.hpp"

namespace standoff {
namespace {

std::string kind_of(const Node& node) {
  if (std::holds_alternative<bool>(node.value)) return "true or false";
  if (std::holds_alternative<long long>(node.value) || std::holds_alternative<double>(node.value)) return "a number";
  if (node.text()) return "a text";
  if (node.array()) return "a list";
  if (node.table()) return "a table";
  return "a date or time";
}

/// What to write instead, when the type is wrong.
std::string wanted(const KeyEntry& entry, bool one_of_three = false) {
  const std::string unit = " (" + std::string(entry.quantity.units) + ")";
  const bool plain = entry.quantity.units.empty();
  const KeyKind one = entry.kind == KeyKind::counts ? KeyKind::count : plain ? KeyKind::number : KeyKind::quantity;
  switch (one_of_three ? one : entry.kind) {
    case KeyKind::quantity:
      return with_article(entry.quantity.name) + " is needed" + unit;
    case KeyKind::number:
      return "a number is needed";
    case KeyKind::count:
      return "a count (a whole number) is needed";
    case KeyKind::flag:
      return "true or false is needed";
    case KeyKind::text:
      return "a text in quotes is needed";
    case KeyKind::choice:
      return "one of its choices is needed";
    case KeyKind::quantities:
      return "three values are needed, each " + with_article(entry.quantity.name) + unit;
    case KeyKind::counts:
      return "three counts are needed, for example [10, 10, 1]";
    case KeyKind::list:
      return "a list is needed, each " + (plain ? "a number" : with_article(entry.quantity.name) + unit);
  }
  return "";
}

class Checker {
 public:
  Checker(const KeyEntry& entry, Diagnostics& diagnostics) : entry_(entry), diagnostics_(diagnostics) {}

  std::optional<Value> check(const Node& node) {
    const std::string name(entry_.key());
    const std::string* text = node.text();
    if (text && entry_.kind == KeyKind::text) return *text;
    for (const std::string& word : entry_.word_list())
      if (text && *text == word) return word;
    switch (entry_.kind) {
      case KeyKind::text:
        return wrong_type(node, name);
      case KeyKind::choice:
        return wrong_word(node, name);
      case KeyKind::flag:
        if (const bool* flag = std::get_if<bool>(&node.value)) return *flag;
        return wrong_type(node, name);
      case KeyKind::count:
        return as_value(count(node, name));
      case KeyKind::number:
      case KeyKind::quantity:
        return as_value(number(node, name));
      case KeyKind::counts:
        return three<CountTriple>(node, [this](const Node& n, const std::string& s) { return count(n, s); });
      case KeyKind::list:
        return several(node);
      case KeyKind::quantities:
        return three<Triple>(node, [this](const Node& n, const std::string& s) { return number(n, s); });
    }
    return std::nullopt;
  }

 private:
  template <class T>
  static std::optional<Value> as_value(const std::optional<T>& part) {
    return part ? std::optional<Value>(*part) : std::nullopt;
  }

  std::nullopt_t fail(const Node& node, const std::string& message, const std::string& hint = "") {
    diagnostics_.error(node.place, message, hint);
    return std::nullopt;
  }
  std::nullopt_t wrong_type(const Node& node, const std::string& name) {
    return fail(node, name + " = " + node.shown() + " is " + kind_of(node) + "; " + wanted(entry_, name.back() == ']'),
                words_hint(node));
  }
  std::nullopt_t wrong_word(const Node& node, const std::string& name) {
    const auto words = entry_.word_list();
    return fail(node, name + " = " + node.shown() + " is not a choice here",
                did_you_mean(node.text() ? *node.text() : "", words, "choices"));
  }
  std::string words_hint(const Node& node) const {
    const auto words = entry_.word_list();
    return words.empty() ? "" : did_you_mean(node.text() ? *node.text() : "", words, "words");
  }
  template <class T>
  std::optional<T> in_range(const Node& node, const std::string& name, T value) {
    if (entry_.range.holds(static_cast<double>(value))) return value;
    const std::string limits = range_text(entry_);
    return fail(node, name + " = " + node.shown() + " is out of range; " + limits + " is needed",
                std::string(entry_.key()) + ": " + std::string(entry_.doc));
  }

  std::optional<long long> count(const Node& node, const std::string& name) {
    const long long* whole = std::get_if<long long>(&node.value);
    if (!whole) return wrong_type(node, name);
    return in_range(node, name, *whole);
  }

  /// A number with or without unit, as the entry asks.
  std::optional<double> number(const Node& node, const std::string& name) {
    const bool plain = entry_.quantity.dimension == Dimension{};
    const std::string shown = name + " = " + node.shown();
    double value = 0.0;
    if (const long long* whole = std::get_if<long long>(&node.value))
      value = static_cast<double>(*whole);
    else if (const double* real = std::get_if<double>(&node.value))
      value = *real;
    else if (!node.text() || plain)
      return wrong_type(node, name);
    if (!node.text()) {
      if (!std::isfinite(value)) return fail(node, shown + " is not a finite number");
      if (plain) return in_range(node, name, value);
      const std::string unit(entry_.quantity.si);
      return fail(node, shown + " has no unit; " + wanted(entry_, name.back() == ']'),
                  "the unit is part of the value: " + in_quotes(node.shown() + " " + unit));
    }
    const ParsedQuantity parsed = parse_quantity(*node.text());
    if (!parsed.error.empty()) {
      const bool worded = parsed.error.starts_with("is ") || parsed.error.starts_with("does ");
      return fail(node, shown + (worded ? " " : ": ") + parsed.error + "; " + wanted(entry_, name.back() == ']'),
                  words_hint(node));
    }
    const std::string mismatch = dimension_mismatch(parsed.dimension, entry_.quantity);
    if (!mismatch.empty()) return fail(node, shown + " " + mismatch);
    return in_range(node, name, parsed.value);
  }

  std::optional<Value> several(const Node& node) {
    const std::string name(entry_.key());
    const Node::Array* list = node.array();
    if (!list || list->empty()) return wrong_type(node, name);
    std::vector<double> result;
    for (std::size_t i = 0; i < list->size(); ++i)
      if (const auto element = number((*list)[i], name + "[" + std::to_string(i) + "]")) result.push_back(*element);
    return result.size() == list->size() ? std::optional<Value>(result) : std::nullopt;
  }

  template <class T, class Part>
  std::optional<Value> three(const Node& node, Part part) {
    const std::string name(entry_.key());
    const Node::Array* list = node.array();
    if (!list && node.text() && !entry_.words.empty()) return wrong_type(node, name);
    if (!list || list->size() != 3)
      return fail(node, name + " = " + node.shown() + " is " +
                            (list ? "a list of " + std::to_string(list->size()) : kind_of(node)) + "; " +
                            wanted(entry_));
    T result{};
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto element = part((*list)[i], name + "[" + std::to_string(i) + "]");
      good = good && element.has_value();
      if (element) result[i] = *element;
    }
    return good ? std::optional<Value>(result) : std::nullopt;
  }

  const KeyEntry& entry_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Value> check_value(const Node& node, const KeyEntry& entry, Diagnostics& diagnostics) {
  return Checker(entry, diagnostics).check(node);
}

Value known_value(std::string_view text, const KeyEntry& entry) {
  const bool is_text = entry.kind == KeyKind::text || entry.kind == KeyKind::choice;
  Node node = is_text ? Node{std::string(text), {}} : read_typed_value(std::string(text), {});
  Diagnostics diagnostics;
  const std::optional<Value> value = check_value(node, entry, diagnostics);
  if (!value)
    throw std::logic_error("built-in value of " + std::string(entry.path) + ": " + diagnostics.errors().front());
  return *value;
}

std::string toml_text(const Value& value, const KeyEntry& entry) {
  const auto number = [&](double x) {
    const std::string text = exact_text(x, entry.quantity);
    if (!entry.quantity.si.empty()) return in_quotes(text);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
  };
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const long long* whole = std::get_if<long long>(&value)) return std::to_string(*whole);
  if (const double* x = std::get_if<double>(&value)) return number(*x);
  if (const std::string* text = std::get_if<std::string>(&value)) return in_quotes(*text);
  std::string list;
  if (const Triple* three = std::get_if<Triple>(&value))
    for (const double x : *three) list += (list.empty() ? "" : ", ") + number(x);
  if (const auto* several = std::get_if<std::vector<double>>(&value))
    for (const double x : *several) list += (list.empty() ? "" : ", ") + number(x);
  if (const CountTriple* three = std::get_if<CountTriple>(&value))
    for (const long long n : *three) list += (list.empty() ? "" : ", ") + std::to_string(n);
  return "[" + list + "]";
}

}  // namespace standoff
