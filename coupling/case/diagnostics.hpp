#pragma once
// Every mistake of a case with the place where it was made, collected so that one reading reports them all.
#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

namespace standoff {

/// Where a value was written: a position in a file, or an option of the command line (line 0, `file` is its text).
struct Place {
  std::string file;
  int line = 0, column = 0;

  std::string text() const {
    return line == 0 ? file : file + ":" + std::to_string(line) + ":" + std::to_string(column);
  }
  friend bool operator==(const Place&, const Place&) = default;
};

class Diagnostics {
 public:
  void error(const Place& place, const std::string& message, const std::string& hint = "") {
    add(errors_, place, "error: " + message, hint);
  }
  void warning(const Place& place, const std::string& message, const std::string& hint = "") {
    add(warnings_, place, "warning: " + message, hint);
  }
  bool any_error() const { return !errors_.empty(); }
  std::vector<std::string> errors() const { return sorted(errors_); }
  std::vector<std::string> warnings() const { return sorted(warnings_); }

 private:
  struct Entry {
    std::size_t file_order;
    int line, column;
    std::string text;
  };

  void add(std::vector<Entry>& list, const Place& place, const std::string& message, const std::string& hint) {
    std::string text = place.text() + ": " + message;
    if (!hint.empty()) text += "\n  " + hint;
    for (const Entry& entry : list)
      if (entry.text == text) return;  // a file included twice is diagnosed once
    const std::string group = place.line == 0 ? "" : place.file;
    auto known = std::find(files_.begin(), files_.end(), group);
    if (known == files_.end()) known = files_.insert(files_.end(), group);
    const auto order = group.empty() ? files_.max_size() : static_cast<std::size_t>(known - files_.begin());
    list.push_back({order, place.line, place.column, std::move(text)});
  }
  /// By file in the order the files were first complained about, then by position; the command line last.
  static std::vector<std::string> sorted(std::vector<Entry> list) {
    std::stable_sort(list.begin(), list.end(), [](const Entry& a, const Entry& b) {
      return std::tie(a.file_order, a.line, a.column) < std::tie(b.file_order, b.line, b.column);
    });
    std::vector<std::string> texts;
    for (Entry& entry : list) texts.push_back(std::move(entry.text));
    return texts;
  }

  std::vector<std::string> files_;
  std::vector<Entry> errors_, warnings_;
};

}  // namespace standoff
