#pragma once
// A TOML file as a plain tree with positions, in the order it was written. The rest of the reader sees only this, so
// the parser library is known to document.cpp alone.
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "coupling/case/diagnostics.hpp"

namespace standoff {

struct Node {
  struct Member;
  using Table = std::vector<Member>;  // in the order of the file
  using Array = std::vector<Node>;
  struct Other {};  // dates and times: legal TOML that no key takes

  std::variant<bool, long long, double, std::string, Array, Table, Other> value;
  Place place;

  const Table* table() const { return std::get_if<Table>(&value); }
  const Array* array() const { return std::get_if<Array>(&value); }
  const std::string* text() const { return std::get_if<std::string>(&value); }
  /// Member `name` of a table, or null.
  const Node* find(const std::string& name) const;
  /// The value as written in an error message: "150 kg" with quotes, 3.4, a table.
  std::string shown() const;
};

struct Node::Member {
  std::string name;
  Place place;
  Node node;
};

/// Reads a file; a missing file or a syntax error is reported at its position. `shown_path` is how messages call it.
std::optional<Node> read_document(const std::string& path, const std::string& shown_path, Diagnostics& diagnostics);

/// Reads the VALUE of KEY=VALUE as typed on a command line: a TOML value, else a list [a, b], else plain text.
Node read_typed_value(const std::string& text, const Place& place);

/// `text` as a TOML string, quoted and escaped.
std::string in_quotes(const std::string& text);

}  // namespace standoff
