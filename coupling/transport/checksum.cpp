#include "coupling/transport/checksum.hpp"

#include <array>
#include <cstring>

#include <immintrin.h>

namespace standoff {
namespace {

constexpr std::size_t stream_bytes =
    1024;  // of each of the three streams; not a page: a load would wait for a store a page before it
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

/// What is left to do, and what has been found so far.
template <bool copying>
struct Pass {
  const unsigned char* at;
  unsigned char* to;  // nowhere, if not copying
  std::size_t size;
  std::uint64_t crc = 0xFFFFFFFFu, found = 0;

  unsigned char* into(std::size_t offset) const { return copying ? to + offset : nullptr; }
  void advance(std::size_t bytes) { size -= bytes, at += bytes, to = into(bytes); }
};

/// One stream of words: remainder, and what `exponent` and `unit` have found.
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
__attribute__((target("sse4.2"))) Copied by_streams(Pass<copying> pass) {
  Stream first{pass.crc, pass.found};
  for (; pass.size >= 3 * stream_bytes; pass.advance(3 * stream_bytes)) {
    Stream second{0, first.found}, third{0, 0};
    for (std::size_t i = 0; i < stream_bytes; i += 8) {
      first.take<copying>(pass.at + i, pass.into(i));
      second.take<copying>(pass.at + stream_bytes + i, pass.into(stream_bytes + i));
      third.take<copying>(pass.at + 2 * stream_bytes + i, pass.into(2 * stream_bytes + i));
    }
    first.found |= second.found | third.found;
    first.crc =
        append_stream(append_stream(static_cast<std::uint32_t>(first.crc)) ^ static_cast<std::uint32_t>(second.crc)) ^
        static_cast<std::uint32_t>(third.crc);
  }
  for (; pass.size >= 8; pass.advance(8)) first.take<copying>(pass.at, pass.to);
  auto rest = static_cast<std::uint32_t>(first.crc);
  for (; pass.size > 0; pass.advance(1)) {
    rest = _mm_crc32_u8(rest, *pass.at);
    if constexpr (copying) *pass.to = *pass.at;
  }
  return {rest ^ 0xFFFFFFFFu, (first.found >> 63) == 0};
}

// Folding: four vectors hold bytes whose remainder is that of all that has been read. Moving them a block on is a
// product with a power of x, without carries: of each half of 16 bytes, the first being of the higher degree.
constexpr std::size_t wide = 32, vectors = 4, block = vectors * wide;

/// x^n modulo the polynomial, bits reflected; one place up, as a product of reflected numbers is one place short.
constexpr long long power_of_x(std::size_t n) {
  std::uint32_t rest = 0x80000000u;
  for (; n > 0; --n) rest = rest >> 1 ^ ((rest & 1) != 0 ? polynomial : 0);
  return static_cast<long long>(rest) << 1;
}
constexpr long long first_half = power_of_x(8 * block + 32), second_half = power_of_x(8 * block - 32);

struct Vectors {
  __m256i held[vectors];
  __m256i lowest;  // of the exponent bits that are not set, in the upper halves of words

  template <bool copying>
  __attribute__((target("avx2,vpclmulqdq"), always_inline)) __m256i load(const Pass<copying>& pass,
                                                                         std::size_t offset) {
    const __m256i words = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(pass.at + offset));
    if constexpr (copying) _mm256_storeu_si256(reinterpret_cast<__m256i*>(pass.into(offset)), words);
    lowest = _mm256_min_epu32(lowest, _mm256_andnot_si256(words, _mm256_set1_epi64x(exponent)));
    return words;
  }
};

/// Takes whole blocks; what is held at their end is a message of its own, whose remainder the instruction finds.
template <bool copying>
__attribute__((target("avx2,vpclmulqdq,sse4.2"))) Pass<copying> by_folding(Pass<copying> pass) {
  if (pass.size < block) return pass;
  Vectors sum{};
  sum.lowest = _mm256_set1_epi32(-1);
  for (std::size_t v = 0; v < vectors; ++v) sum.held[v] = sum.load(pass, v * wide);
  sum.held[0] = _mm256_xor_si256(sum.held[0], _mm256_set_epi64x(0, 0, 0, static_cast<long long>(pass.crc)));
  const __m256i powers = _mm256_set_epi64x(second_half, first_half, second_half, first_half);
  for (pass.advance(block); pass.size >= block; pass.advance(block))
    for (std::size_t v = 0; v < vectors; ++v) {
      const __m256i first = _mm256_clmulepi64_epi128(sum.held[v], powers, 0x00);
      const __m256i second = _mm256_clmulepi64_epi128(sum.held[v], powers, 0x11);
      sum.held[v] = _mm256_xor_si256(sum.load(pass, v * wide), _mm256_xor_si256(first, second));
    }
  std::array<std::uint64_t, block / 8> held;
  std::memcpy(held.data(), sum.held, sizeof held);
  pass.crc = 0;
  for (const std::uint64_t word : held) pass.crc = _mm_crc32_u64(pass.crc, word);
  std::array<std::uint64_t, wide / 8> lowest;
  std::memcpy(lowest.data(), &sum.lowest, sizeof lowest);
  for (const std::uint64_t word : lowest)
    if (word >> 32 == 0) pass.found = exponent + unit;
  return pass;
}

template <bool copying>
Copied pass_over(Pass<copying> pass, bool fold) {
  return by_streams(fold ? by_folding(pass) : pass);
}

}  // namespace

bool processor_folds() {
  static const bool can = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("vpclmulqdq");
  return can;
}

std::uint32_t crc32c(const void* data, std::size_t size, bool fold) {
  return pass_over<false>({static_cast<const unsigned char*>(data), nullptr, size}, fold).checksum;
}

Copied copy_checked(void* to, const void* from, std::size_t size, bool fold) {
  return pass_over<true>({static_cast<const unsigned char*>(from), static_cast<unsigned char*>(to), size}, fold);
}

bool all_finite(const void* data, std::size_t count) {
  const auto* at = static_cast<const unsigned char*>(data);
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < count; ++i) any |= (word_at(at + 8 * i) & exponent) + unit;
  return (any >> 63) == 0;
}

}  // namespace standoff
