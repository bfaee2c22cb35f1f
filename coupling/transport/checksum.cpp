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

}  // namespace

__attribute__((target("sse4.2"))) std::uint32_t crc32c(const void* data, std::size_t size) {
  const auto* at = static_cast<const unsigned char*>(data);
  std::uint64_t crc = 0xFFFFFFFFu;
  for (; size >= 3 * stream_bytes; size -= 3 * stream_bytes, at += 3 * stream_bytes) {
    std::uint64_t second = 0, third = 0;
    for (std::size_t i = 0; i < stream_bytes; i += 8) {
      crc = _mm_crc32_u64(crc, word_at(at + i));
      second = _mm_crc32_u64(second, word_at(at + stream_bytes + i));
      third = _mm_crc32_u64(third, word_at(at + 2 * stream_bytes + i));
    }
    crc = append_stream(append_stream(static_cast<std::uint32_t>(crc)) ^ static_cast<std::uint32_t>(second)) ^
          static_cast<std::uint32_t>(third);
  }
  for (; size >= 8; size -= 8, at += 8) crc = _mm_crc32_u64(crc, word_at(at));
  auto rest = static_cast<std::uint32_t>(crc);
  for (; size > 0; --size, ++at) rest = _mm_crc32_u8(rest, *at);
  return rest ^ 0xFFFFFFFFu;
}

bool all_finite(const void* data, std::size_t count) {
  // All exponent bits set means infinity or not a number: adding one unit to the exponent then reaches the sign bit.
  constexpr std::uint64_t exponent = 0x7FF0000000000000ull, unit = 0x0010000000000000ull;
  const auto* at = static_cast<const unsigned char*>(data);
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < count; ++i) any |= (word_at(at + 8 * i) & exponent) + unit;
  return (any >> 63) == 0;
}

}  // namespace standoff
