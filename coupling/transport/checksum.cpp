#include "coupling/transport/checksum.hpp"

#include <array>
#include <cstring>

#include <nmmintrin.h>

namespace standoff {
namespace {

constexpr std::size_t stream_bytes = 4096;  // of each of the three streams
constexpr std::uint32_t polynomial = 0x82F63B78u;

using BitMatrix = std::array<std::uint32_t, 32>;                   // column b: what bit b becomes
using ByteTables = std::array<std::array<std::uint32_t, 256>, 4>;  // the same, byte by byte

constexpr std::uint32_t times(const BitMatrix& matrix, std::uint32_t bits) {
  std::uint32_t sum = 0;
  for (std::size_t b = 0; bits != 0; bits >>= 1, ++b)
    if (bits & 1u) sum ^= matrix[b];
  return sum;
}

/// What `stream_bytes` zero bytes do to a remainder: the map of one zero bit, squared until it stands for that many.
constexpr ByteTables zeros_tables() {
  BitMatrix matrix{};
  matrix[0] = polynomial;
  for (std::size_t b = 1; b < 32; ++b) matrix[b] = 1u << (b - 1);
  for (std::size_t bits = 1; bits < 8 * stream_bytes; bits *= 2) {
    BitMatrix square{};
    for (std::size_t b = 0; b < 32; ++b) square[b] = times(matrix, matrix[b]);
    matrix = square;
  }
  ByteTables tables{};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::uint32_t v = 0; v < 256; ++v) tables[k][v] = times(matrix, v << (8 * k));
  return tables;
}
constexpr ByteTables after_zeros = zeros_tables();

std::uint32_t append_stream(std::uint32_t crc) {
  return after_zeros[0][crc & 255] ^ after_zeros[1][crc >> 8 & 255] ^ after_zeros[2][crc >> 16 & 255] ^
         after_zeros[3][crc >> 24];
}

std::uint64_t word_at(const unsigned char* bytes) {
  std::uint64_t word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

// All exponent bits set means infinity or not a number: adding one unit to the exponent then reaches the sign bit.
constexpr std::uint64_t exponent = 0x7FF0000000000000ull, unit = 0x0010000000000000ull;

/// One stream: remainder, and what `exponent` and `unit` have found so far.
struct Stream {
  std::uint64_t crc = 0, found = 0;

  template <bool copying>
  __attribute__((target("sse4.2"), always_inline)) void take(const unsigned char* from, unsigned char* to) {
    const std::uint64_t word = word_at(from);
    if constexpr (copying) std::memcpy(to, &word, sizeof word);
    crc = _mm_crc32_u64(crc, word);
    found |= (word & exponent) + unit;
  }
};

template <bool copying>
__attribute__((target("sse4.2"))) Copied pass_over(const unsigned char* at, unsigned char* to, std::size_t size) {
  Stream first{0xFFFFFFFFu, 0};
  const auto advance = [&](std::size_t bytes) { size -= bytes, at += bytes, to += copying ? bytes : 0; };
  const auto into = [&](std::size_t offset) { return copying ? to + offset : nullptr; };  // nowhere has no places in it
  for (; size >= 3 * stream_bytes; advance(3 * stream_bytes)) {
    Stream second{0, first.found}, third{0, 0};
    for (std::size_t i = 0; i < stream_bytes; i += 8) {
      first.take<copying>(at + i, into(i));
      second.take<copying>(at + stream_bytes + i, into(stream_bytes + i));
      third.take<copying>(at + 2 * stream_bytes + i, into(2 * stream_bytes + i));
    }
    first.found |= second.found | third.found;
    first.crc =
        append_stream(append_stream(static_cast<std::uint32_t>(first.crc)) ^ static_cast<std::uint32_t>(second.crc)) ^
        static_cast<std::uint32_t>(third.crc);
  }
  for (; size >= 8; advance(8)) first.take<copying>(at, to);
  auto rest = static_cast<std::uint32_t>(first.crc);
  for (; size > 0; advance(1)) {
    rest = _mm_crc32_u8(rest, *at);
    if constexpr (copying) *to = *at;
  }
  return {rest ^ 0xFFFFFFFFu, (first.found >> 63) == 0};
}

}  // namespace

std::uint32_t crc32c(const void* data, std::size_t size) {
  return pass_over<false>(static_cast<const unsigned char*>(data), nullptr, size).checksum;
}

Copied copy_checked(void* to, const void* from, std::size_t size) {
  return pass_over<true>(static_cast<const unsigned char*>(from), static_cast<unsigned char*>(to), size);
}

bool all_finite(const void* data, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(data);
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < count; ++i) any |= (word_at(at + 8 * i) & exponent) + unit;
  return (any >> 63) == 0;
}

}  // namespace standoff
