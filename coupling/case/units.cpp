#include "coupling/case/units.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

#include "coupling/case/near_word.hpp"

namespace standoff {
namespace {

using Wide = unsigned __int128;

/// numerator / denominator * 10^ten, in SI. Kept as integers so that scaling by decimal units rounds only once.
struct Factor {
  std::uint64_t numerator = 1, denominator = 1;
  int ten = 0;
};

struct Unit {
  std::string_view symbol;
  Dimension dimension;
  Factor factor;
  bool takes_prefix = false;
};

constexpr Dimension force{{1, 1, -2, 0}}, stress{{1, -1, -2, 0}}, work{{1, 2, -2, 0}};

// Exact definitions: inch and pound of 1959 (25.4 mm, 0.45359237 kg), standard gravity 9.80665 m/s2, atm 101325 Pa.
// lbf = 0.45359237 * 9.80665 N; psi = lbf / in2.
constexpr Unit units[] = {
    {"m", {{0, 1, 0, 0}}, {}, true},
    {"g", {{1, 0, 0, 0}}, {1, 1, -3}, true},
    {"s", {{0, 0, 1, 0}}, {}, true},
    {"K", {{0, 0, 0, 1}}, {}, true},
    {"N", force, {}, true},
    {"Pa", stress, {}, true},
    {"J", work, {}, true},
    {"W", {{1, 2, -3, 0}}, {}, true},
    {"Hz", {{0, 0, -1, 0}}, {}, true},
    {"bar", stress, {1, 1, 5}, true},
    {"t", {{1, 0, 0, 0}}, {1, 1, 3}},
    {"L", {{0, 3, 0, 0}}, {1, 1, -3}, true},
    {"l", {{0, 3, 0, 0}}, {1, 1, -3}, true},
    {"min", {{0, 0, 1, 0}}, {6, 1, 1}},
    {"h", {{0, 0, 1, 0}}, {36, 1, 2}},
    {"in", {{0, 1, 0, 0}}, {254, 1, -4}},
    {"inch", {{0, 1, 0, 0}}, {254, 1, -4}},
    {"ft", {{0, 1, 0, 0}}, {3048, 1, -4}},
    {"lb", {{1, 0, 0, 0}}, {45359237, 1, -8}},
    {"lbm", {{1, 0, 0, 0}}, {45359237, 1, -8}},
    {"oz", {{1, 0, 0, 0}}, {28349523125, 1, -12}},
    {"lbf", force, {44482216152605, 1, -13}},
    {"psi", stress, {44482216152605, 64516, -5}},
    {"ksi", stress, {44482216152605, 64516, -2}},
    {"atm", stress, {101325, 1, 0}},
};

struct Prefix {
  std::string_view symbol;
  int ten;
};
constexpr Prefix prefixes[] = {{"T", 12}, {"G", 9},  {"M", 6},       {"k", 3},       {"h", 2},  {"d", -1}, {"c", -2},
                               {"m", -3}, {"u", -6}, {"\u00b5", -6}, {"\u03bc", -6}, {"n", -9}, {"p", -12}};

std::optional<Unit> find_unit(std::string_view symbol) {
  for (const Unit& unit : units)
    if (unit.symbol == symbol) return unit;
  for (const Prefix& prefix : prefixes) {
    if (!symbol.starts_with(prefix.symbol)) continue;
    for (Unit unit : units) {
      if (!unit.takes_prefix || unit.symbol != symbol.substr(prefix.symbol.size())) continue;
      unit.factor.ten += prefix.ten;
      return unit;
    }
  }
  return std::nullopt;
}

/// Symbols worth suggesting for a misspelt one.
std::vector<std::string> common_symbols() {
  return {"m",  "cm", "mm", "um", "km",  "in",  "ft",  "kg",  "g",   "lb",  "s",   "ms", "us", "ns", "K",  "N",
          "kN", "MN", "GN", "Pa", "kPa", "MPa", "GPa", "bar", "psi", "ksi", "atm", "J",  "kJ", "MJ", "GJ", "min"};
}

/// Product of two factors; false if the integers no longer fit.
bool multiply(Factor& a, const Factor& b) {
  a.ten += b.ten;
  return !__builtin_mul_overflow(a.numerator, b.numerator, &a.numerator) &&
         !__builtin_mul_overflow(a.denominator, b.denominator, &a.denominator);
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Superscripts and the middle dot, as typed on many keyboards, to plain ASCII.
std::string plain_ascii(std::string_view text) {
  static constexpr std::pair<std::string_view, std::string_view> same[] = {
      {"\u00b2", "2"}, {"\u00b3", "3"}, {"\u00b7", "*"}, {"\u22c5", "*"}, {"\u207b", "-"}, {"\u00b9", "1"}};
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    bool replaced = false;
    for (const auto& [from, to] : same) {
      if (!text.substr(i).starts_with(from)) continue;
      out += to, i += from.size(), replaced = true;
      break;
    }
    if (!replaced) out += text[i++];
  }
  return out;
}

/// expression := factor { [ * | . | / ] factor };  factor := ( 1 | symbol | "(" expression ")" ) [ [^] integer ]
class UnitExpression {
 public:
  explicit UnitExpression(std::string_view text) : text_(text) {}

  bool parse() {
    if (!product(dimension, factor, 0)) return false;
    return at_ == text_.size() || fail("cannot read the unit from \"" + std::string(text_.substr(at_)) + "\"");
  }

  Dimension dimension;
  Factor factor;
  std::string error;

 private:
  bool fail(std::string message) {
    if (error.empty()) error = std::move(message);
    return false;
  }
  char peek() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool product(Dimension& d, Factor& f, int depth) {
    if (depth > 8) return fail("too many parentheses in the unit");
    for (bool first = true;; first = false) {
      const char c = peek();
      if (c == '\0' || c == ')') return !first || depth == 0 || fail("empty parentheses in the unit");
      const bool divide = c == '/';
      if (divide || (!first && (c == '*' || c == '.'))) ++at_;
      Dimension d1;
      Factor f1;
      if (!single(d1, f1, depth)) return false;
      const int sign = divide ? -1 : 1;
      for (std::size_t i = 0; i < 4; ++i) d.exponent[i] += sign * d1.exponent[i];
      if (divide) std::swap(f1.numerator, f1.denominator), f1.ten = -f1.ten;
      if (!multiply(f, f1)) return fail("the unit is too involved");
    }
  }

  bool single(Dimension& d, Factor& f, int depth) {
    const char c = peek();
    if (c == '(') {
      ++at_;
      if (!product(d, f, depth + 1)) return false;
      if (peek() != ')') return fail("a closing parenthesis is missing in the unit");
      ++at_;
    } else if (c == '1') {
      ++at_;
      return peek() == '/' || fail("cannot read the unit from \"" + std::string(text_.substr(at_ - 1)) + "\"");
    } else if (!symbol(d, f)) {
      return false;
    }
    return power(d, f);
  }

  bool symbol(Dimension& d, Factor& f) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    if (name.empty()) return fail("cannot read the unit from \"" + std::string(text_.substr(begin)) + "\"");
    const std::optional<Unit> unit = find_unit(name);
    if (!unit) {
      const std::string near = nearest_word(name, common_symbols());
      return fail("unknown unit \"" + name + "\"" + (near.empty() ? "" : "; did you mean \"" + near + "\"?"));
    }
    d = unit->dimension, f = unit->factor;
    return true;
  }

  bool power(Dimension& d, Factor& f) {
    std::size_t i = at_;
    if (i < text_.size() && text_[i] == '^') ++i;
    const bool negative = i < text_.size() && text_[i] == '-';
    if (negative) ++i;
    if (i >= text_.size() || !is_digit(text_[i])) return i == at_ || fail("a power is missing in the unit");
    const int exponent = text_[i] - '0';
    if (exponent == 0 || (i + 1 < text_.size() && is_digit(text_[i + 1]))) return fail("powers in a unit are 1 to 9");
    at_ = i + 1;
    Factor result;
    for (int k = 0; k < exponent; ++k)
      if (!multiply(result, f)) return fail("the unit is too involved");
    if (negative) std::swap(result.numerator, result.denominator), result.ten = -result.ten;
    f = result;
    for (int& e : d.exponent) e *= negative ? -exponent : exponent;
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// A decimal number taken apart: digits * 10^ten, and how many characters it used (0: not a number).
struct Decimal {
  bool negative = false;
  std::string digits;
  int ten = 0;
  std::size_t length = 0;
};

Decimal take_decimal(std::string_view text) {
  Decimal number;
  std::size_t i = 0;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) number.negative = text[i++] == '-';
  bool point = false;
  for (; i < text.size(); ++i) {
    const bool between_digits = i > 0 && is_digit(text[i - 1]) && i + 1 < text.size() && is_digit(text[i + 1]);
    if (is_digit(text[i])) {
      number.digits += text[i];
      number.ten -= point ? 1 : 0;
    } else if (text[i] == '.' && !point && i + 1 < text.size() && is_digit(text[i + 1])) {
      point = true;
    } else if (text[i] != '_' || !between_digits) {
      break;
    }
  }
  if (number.digits.empty()) return {};
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t j = i + 1;
    if (j < text.size() && text[j] == '+') ++j;
    int exponent = 0;
    const auto [end, problem] = std::from_chars(text.data() + j, text.data() + text.size(), exponent);
    const bool plus_minus = j + 1 < text.size() && text[j] == '-' && text[j - 1] == '+';
    if (problem == std::errc() && !plus_minus && std::abs(exponent) < 100000) {
      number.ten += exponent;
      i = static_cast<std::size_t>(end - text.data());
    }
  }
  number.length = i;
  return number;
}

std::string decimal_text(Wide value) {
  std::string text;
  do text.insert(text.begin(), static_cast<char>('0' + static_cast<int>(value % 10)));
  while ((value /= 10) != 0);
  return text;
}

/// digits * 10^ten * factor, rounded once where the factor is a finite decimal of moderate length.
std::optional<double> scale(const Decimal& number, Factor factor) {
  std::string digits = number.digits;
  const std::size_t zeros = digits.find_first_not_of('0');
  digits.erase(0, zeros == std::string::npos ? digits.size() - 1 : zeros);
  if (factor.numerator > 1 && digits.size() <= 19) {
    Wide product = 0;
    for (const char c : digits) product = product * 10 + static_cast<unsigned>(c - '0');
    digits = decimal_text(product * factor.numerator);  // < 10^19 * 2^64 < 2^128
    factor.numerator = 1;
  }
  const std::string text = digits + "e" + std::to_string(number.ten + factor.ten);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (factor.numerator != 1 || factor.denominator != 1)  // psi, per inch, or more digits than a double holds
    value = static_cast<double>(static_cast<long double>(value) * static_cast<long double>(factor.numerator) /
                                static_cast<long double>(factor.denominator));
  return number.negative ? -value : value;
}

}  // namespace

ParsedQuantity parse_quantity(std::string_view original) {
  ParsedQuantity parsed;
  const std::string text = plain_ascii(original);
  const std::size_t begin = text.find_first_not_of(' ');
  const std::string_view trimmed = begin == std::string::npos ? "" : std::string_view(text).substr(begin);
  const Decimal number = take_decimal(trimmed);
  if (number.length == 0) {
    parsed.error = "does not begin with a number";
    return parsed;
  }
  UnitExpression unit(trimmed.substr(number.length));
  if (!unit.parse()) {
    parsed.error = unit.error;
    return parsed;
  }
  parsed.dimension = unit.dimension;
  const std::optional<double> value = scale(number, unit.factor);
  if (!value) parsed.error = "is too large or too small for a number";
  parsed.value = value.value_or(0.0);
  return parsed;
}

std::string with_article(std::string_view word) {
  const bool vowel = !word.empty() && std::string_view("aeiou").find(word.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(word);
}

std::string describe_dimension(const Dimension& dimension) {
  using namespace quantity;
  static constexpr Quantity named[] = {none,
                                       mass,
                                       length,
                                       time,
                                       temperature,
                                       speed,
                                       rate,
                                       density,
                                       pressure,
                                       stiffness,
                                       impulse,
                                       specific_heat,
                                       expansion,
                                       {"area", {{0, 2, 0, 0}}, "", ""},
                                       {"volume", {{0, 3, 0, 0}}, "", ""},
                                       {"force", force, "", ""},
                                       {"energy", work, "", ""},
                                       {"acceleration", {{0, 1, -2, 0}}, "", ""},
                                       {"power", {{1, 2, -3, 0}}, "", ""},
                                       {"mass per area", {{1, -2, 0, 0}}, "", ""},
                                       {"energy per mass", {{0, 2, -2, 0}}, "", ""}};
  for (const Quantity& quantity : named)
    if (quantity.dimension == dimension) return with_article(quantity.name);
  static constexpr std::string_view base[] = {"kg", "m", "s", "K"};
  std::string text = "a quantity in";
  for (std::size_t i = 0; i < 4; ++i) {
    const int e = dimension.exponent[i];
    if (e != 0) text.append(" ").append(base[i]).append(e == 1 ? "" : std::to_string(e));
  }
  return text;
}

std::string dimension_mismatch(const Dimension& found, const Quantity& wanted) {
  if (found == wanted.dimension) return "";
  return "is " + describe_dimension(found) + "; " + with_article(wanted.name) + " is needed" +
         (wanted.units.empty() ? "" : " (" + std::string(wanted.units) + ")");
}

std::string exact_text(double value) {
  char buffer[40];
  const auto [end, problem] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return problem == std::errc() ? std::string(buffer, end) : "nan";
}

std::string exact_text(double value, const Quantity& quantity) {
  return exact_text(value).append(quantity.si.empty() ? "" : " ").append(quantity.si);
}

std::string readable_text(double value, const Quantity& quantity) {
  static constexpr std::pair<std::string_view, double> steps[] = {{"G", 1e9},  {"M", 1e6},  {"k", 1e3}, {"", 1.0},
                                                                  {"m", 1e-3}, {"u", 1e-6}, {"n", 1e-9}};
  std::string unit(quantity.si);
  const bool mass = unit == "kg";
  if (mass) unit = "g", value *= 1e3;
  const bool prefixed = mass || (!unit.empty() && unit != "kg/m3" && unit != "K" && unit.front() != '1');
  std::string_view prefix;
  double scaled = value;
  if (prefixed && value != 0.0)
    for (const auto& [symbol, size] : steps) {
      prefix = symbol, scaled = value / size;
      if (std::abs(scaled) >= 1.0) break;
    }
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", scaled);
  return std::string(buffer).append(unit.empty() ? "" : " ").append(prefix).append(unit);
}

}  // namespace standoff
