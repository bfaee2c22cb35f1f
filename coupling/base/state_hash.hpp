#pragma once
// A 64-bit fingerprint of simulation state: two runs with the same hash hold the same bits.
// FNV-1a over 64-bit words followed by the SplitMix64 finaliser (Steele, Lea, Flood, OOPSLA 2014, fig. 16).
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "coupling/base/vec3.hpp"

namespace standoff {

class StateHash {
 public:
  void add(std::uint64_t word) { state_ = (state_ ^ word) * 0x100000001B3ull; }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  template <class T>
  void add(std::span<const T> values) {
    for (const T& v : values) add(v);
  }
  void add(std::string_view text) {
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }
  std::uint64_t value() const {
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  /// Sixteen lower-case hexadecimal digits.
  std::string hex() const {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text(16, '0');
    std::uint64_t v = value();
    for (int i = 15; i >= 0; --i, v >>= 4) text[static_cast<std::size_t>(i)] = digits[v & 15];
    return text;
  }

 private:
  std::uint64_t state_ = 0xCBF29CE484222325ull;
};

}  // namespace standoff
