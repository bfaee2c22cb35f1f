#include "coupling/launcher/text_format.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace standoff::launch {
namespace {

struct Suffix {
  const char* suffix;
  double factor;
  const char* unit;
};
// Longest first: "_m_per_period" ends in neither "_m" nor "_s".
constexpr Suffix suffixes[] = {{"_m_per_period", 1e6, "um/period"},
                               {"_per_s", 1.0, "1/s"},
                               {"_Pa_s", 1.0, "Pa s"},
                               {"_Ns", 1.0, "N s"},
                               {"_Hz", 1.0, "Hz"},
                               {"_m", 1e3, "mm"},
                               {"_K", 1.0, "K"},
                               {"_J", 1.0, "J"},
                               {"_N", 1.0, "N"},
                               {"_s", 1e6, "us"}};

const Suffix* suffix_of(const std::string& key) {
  for (const Suffix& s : suffixes)
    if (key.ends_with(s.suffix)) return &s;
  return nullptr;
}

/// Columns, not bytes: every byte of UTF-8 but the continuation ones.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string with_separators(long value) {
  const std::string digits = std::to_string(std::labs(value));
  std::string text;
  if (value < 0) text.push_back('-');
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text.push_back(',');
    text.push_back(digits[i]);
  }
  return text;
}

std::string clock_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0 || seconds > 1e8) return "--:--:--";
  const long whole = std::lround(seconds);
  return fmt::format("{:02}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string duration_text(double seconds) {
  const double size = std::abs(seconds);
  if (!std::isfinite(seconds)) return "?";
  if (size < 1e-6) return fmt::format("{:.3g} ns", seconds * 1e9);
  if (size < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  if (size < 1.0) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.3g} s", seconds);
}

std::string bytes_text(double bytes) {
  if (bytes < 1e3) return fmt::format("{:.0f} B", bytes);
  if (bytes < 1e6) return fmt::format("{:.0f} kB", bytes / 1e3);
  if (bytes < 1e9) return fmt::format("{:.1f} MB", bytes / 1e6);
  return fmt::format("{:.2f} GB", bytes / 1e9);
}

std::string wall_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  if (seconds < 300.0) return fmt::format("{:.1f} s", seconds);
  if (seconds < 3.0 * 3600.0) return fmt::format("{:.1f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string value_text(const std::string& key, double value) {
  const Suffix* suffix = suffix_of(key);
  if (suffix == nullptr) return fmt::format("{:.4g}", value);
  const double shown = value * suffix->factor;
  const double size = std::abs(shown);
  if (size >= 0.1 && size < 1e4) return fmt::format("{:.{}f} {}", shown, size < 100.0 ? 2 : 1, suffix->unit);
  return fmt::format("{:.4g} {}", shown, suffix->unit);
}

std::string label_of(const std::string& key) {
  std::string label = key.substr(key.rfind('.') + 1);
  if (const Suffix* suffix = suffix_of(label)) label.resize(label.size() - std::string(suffix->suffix).size());
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

std::string table_text(const std::vector<std::vector<std::string>>& rows, const std::vector<bool>& right,
                       const std::string& indent) {
  std::vector<std::size_t> widths(right.size());
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  std::string text;
  for (const auto& row : rows) {
    std::string line = indent;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(widths[c] - width(row[c]), ' ');
      line += (c > 0 ? "  " : "") + (right[c] ? padding + row[c] : row[c] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace standoff::launch
