#pragma once
// "Did you mean": the nearest of a few known words.
#include <algorithm>
#include <cctype>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace standoff {

/// Smallest number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`
/// (optimal string alignment). Case is ignored: a wrong capital letter is the nearest slip of all.
inline int edit_distance(std::string_view a, std::string_view b) {
  const auto same = [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  };
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replace = last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

/// The known word nearest to `word`, or "" if none is near enough to be a slip of the fingers.
inline std::string nearest_word(std::string_view word, std::span<const std::string> known) {
  std::string best;
  int best_distance = (static_cast<int>(word.size()) + 2) / 3 + 1;  // one slip in three letters, and none further
  for (const std::string& candidate : known) {
    const bool begun = word.size() >= 4 && candidate.starts_with(word);  // "stand" for "stand_off"
    const int distance = begun ? 1 : edit_distance(word, candidate);
    if (distance < best_distance) best = candidate, best_distance = distance;
  }
  return best;
}

/// "a, b, c"
inline std::string join_words(std::span<const std::string> words, std::string_view separator = ", ") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : std::string(separator)) + word;
  return text;
}

/// `did you mean "x"?  keys here: a, b` with the parts that apply.
inline std::string did_you_mean(std::string_view word, std::span<const std::string> known, std::string_view heading) {
  const std::string near = nearest_word(word, known);
  std::string text = near.empty() ? "" : "did you mean \"" + near + "\"?";
  if (!known.empty() && !heading.empty())
    text += (text.empty() ? "" : "  ") + std::string(heading) + ": " + join_words(known);
  return text;
}

}  // namespace standoff
