#pragma once
// Values with units: "3.4 mm", "0.4 GN/m", "8.7 GJ/m3", "2 ms", "130 N s". The unit is part of the value, so a number
// with the wrong dimension cannot get into a case. The decimal text is scaled, not the binary number: "3.4 mm" gives
// the double nearest to 0.0034, the same bits as the literal 0.0034 (the property that makes resolved cases
// repeatable).
#include <array>
#include <span>
#include <string>
#include <string_view>

namespace standoff {

/// Exponents of mass, length, time, temperature.
struct Dimension {
  std::array<int, 4> exponent{};
  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

/// A kind of value a key asks for. Two quantities may share a dimension (pressure, energy density).
struct Quantity {
  std::string_view name;  // "length"
  Dimension dimension;
  std::string_view si;     // unit written into resolved cases: "m"
  std::string_view units;  // units offered to a user who gave none or the wrong one
};

namespace quantity {
inline constexpr Quantity none{"plain number", {}, "", ""};
inline constexpr Quantity mass{"mass", {{1, 0, 0, 0}}, "kg", "kg, g, lb"};
inline constexpr Quantity length{"length", {{0, 1, 0, 0}}, "m", "m, cm, mm, in, ft"};
inline constexpr Quantity time{"time", {{0, 0, 1, 0}}, "s", "s, ms, us"};
inline constexpr Quantity temperature{"temperature", {{0, 0, 0, 1}}, "K", "K"};
inline constexpr Quantity speed{"speed", {{0, 1, -1, 0}}, "m/s", "m/s, km/s, ft/s"};
inline constexpr Quantity rate{"rate", {{0, 0, -1, 0}}, "1/s", "1/s, 1/ms"};
inline constexpr Quantity density{"density", {{1, -3, 0, 0}}, "kg/m3", "kg/m3, g/cm3"};
inline constexpr Quantity energy_density{"energy per volume", {{1, -1, -2, 0}}, "J/m3", "J/m3, MJ/m3, GJ/m3, kJ/cm3"};
inline constexpr Quantity pressure{"pressure", {{1, -1, -2, 0}}, "Pa", "Pa, kPa, MPa, GPa, bar, psi"};
inline constexpr Quantity stiffness{"stiffness", {{1, 0, -2, 0}}, "N/m", "N/m, kN/m, GN/m"};
inline constexpr Quantity impulse{"impulse", {{1, 1, -1, 0}}, "N s", "N s, kN s"};
inline constexpr Quantity specific_heat{"specific heat", {{0, 2, -2, -1}}, "J/(kg K)", "J/(kg K), kJ/(kg K)"};
inline constexpr Quantity expansion{"thermal expansion", {{0, 0, 0, -1}}, "1/K", "1/K"};
}  // namespace quantity

/// A value in SI, or what is wrong with the text.
struct ParsedQuantity {
  double value = 0.0;  // SI; meaningful only if error is empty
  Dimension dimension;
  std::string error;  // "unknown unit "mmm"; did you mean "mm"?"
};

/// Reads a number followed by a unit expression: prefixes, products (space, *, .), quotients, powers (m3, m^3, s-1),
/// parentheses. A bare number has the dimension of a plain number.
ParsedQuantity parse_quantity(std::string_view text);

/// What a dimension is called: "a mass", "a pressure", or "a quantity in kg2 m".
std::string describe_dimension(const Dimension& dimension);

/// Empty if `parsed` is a `wanted`; otherwise the end of a sentence: "is a mass; a length is needed (m, cm, mm, in,
/// ft)".
std::string dimension_mismatch(const Dimension& found, const Quantity& wanted);

/// "a" or "an" before a word.
std::string with_article(std::string_view word);

/// Shortest decimal text that reads back to the same double.
std::string exact_text(double value);
/// The same with the SI unit: "0.0034 m".
std::string exact_text(double value, const Quantity& quantity);

/// For people: six digits at most and a fitting prefix, "28.2 mm".
std::string readable_text(double value, const Quantity& quantity);

}  // namespace standoff
