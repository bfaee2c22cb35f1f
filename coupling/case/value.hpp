#pragma once
// A value of a case after its unit, type and range were checked: SI, ready to use.
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "coupling/case/document.hpp"
#include "coupling/case/schema.hpp"

namespace standoff {

using Triple = std::array<double, 3>;
using CountTriple = std::array<long long, 3>;
/// A text holds the words of texts, choices and words taken beside a number.
using Value = std::variant<bool, long long, double, std::string, Triple, CountTriple, std::vector<double>>;

/// Checks `node` against what `entry` asks for; every mistake is reported at its own position.
std::optional<Value> check_value(const Node& node, const KeyEntry& entry, Diagnostics& diagnostics);

/// The value of a fallback or preset text, which is known to be right: "1 ms", "[10, 10, 1]", "parallel", "5".
Value known_value(std::string_view text, const KeyEntry& entry);

/// The value as TOML: "0.0034 m" in quotes, 0.3, [10, 10, 1].
std::string toml_text(const Value& value, const KeyEntry& entry);

}  // namespace standoff
