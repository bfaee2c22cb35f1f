#pragma once
// Four doubles side by side, so that a law written once for a number type runs on one pair or on four pairs at a time.
//
// Kernels use + - * / and the five functions below; they are given here for `double` and for `Lanes`. Each lane
// performs the same IEEE operations as the scalar version, so both give the same bits. The only file of the sand with
// instructions in it.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <immintrin.h>

namespace standoff::particles {

using Lanes = double __attribute__((vector_size(32)));
using LaneMask = decltype(Lanes{} < Lanes{});

/// A particle as one 32-byte record: a vector and one more number.
struct alignas(32) GrainRecord {
  double x = 0.0, y = 0.0, z = 0.0, w = 0.0;
};

inline double root(double a) {
  return std::sqrt(a);
}
inline double larger(double a, double b) {
  return a > b ? a : b;
}
inline double choose(bool condition, double yes, double no) {
  return condition ? yes : no;
}
inline double nearest_integer(double a) {
  return std::nearbyint(a);
}
inline bool any(bool condition) {
  return condition;
}

inline Lanes root(Lanes a) {
  return Lanes(_mm256_sqrt_pd(__m256d(a)));
}
inline Lanes larger(Lanes a, Lanes b) {
  return Lanes(_mm256_max_pd(__m256d(a), __m256d(b)));
}
inline Lanes choose(LaneMask condition, Lanes yes, Lanes no) {
  return Lanes(_mm256_blendv_pd(__m256d(no), __m256d(yes), __m256d(condition)));
}
inline Lanes nearest_integer(Lanes a) {
  return Lanes(_mm256_round_pd(__m256d(a), _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC));
}
inline bool any(LaneMask condition) {
  return _mm256_movemask_pd(__m256d(condition)) != 0;
}

/// One bit a lane.
inline unsigned lane_bits(LaneMask condition) {
  return static_cast<unsigned>(_mm256_movemask_pd(__m256d(condition)));
}

/// Byte orders that move the chosen ones of four 32-bit numbers to the front.
inline constexpr auto chosen_first = [] {
  std::array<std::array<std::uint8_t, 16>, 16> table{};
  for (unsigned bits = 0; bits < 16; ++bits)
    for (unsigned lane = 0, place = 0; lane < 4; ++lane)
      if (bits >> lane & 1)
        for (unsigned byte = 0; byte < 4; ++byte)
          table[bits][4 * place + byte] = static_cast<std::uint8_t>(4 * lane + byte), place += byte == 3;
  return table;
}();

/// Writes the chosen ones of four numbers to `out`, in order, and whatever after them (room for four is needed).
/// Returns how many were chosen. No branch: which pairs touch cannot be foreseen.
inline std::size_t append_chosen(unsigned bits, const std::uint32_t* four, std::uint32_t* out) {
  const __m128i order = _mm_loadu_si128(reinterpret_cast<const __m128i*>(chosen_first[bits].data()));
  const __m128i numbers = _mm_loadu_si128(reinterpret_cast<const __m128i*>(four));
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(numbers, order));
  return static_cast<std::size_t>(std::popcount(bits));
}

inline Lanes all_lanes(double a) {
  return Lanes{a, a, a, a};
}
inline Lanes load(const GrainRecord& r) {
  return Lanes(_mm256_load_pd(&r.x));
}
inline Lanes load(const double* four) {
  return Lanes(_mm256_load_pd(four));
}
/// The same from an address that need not be a multiple of 32.
inline Lanes load_anywhere(const double* four) {
  return Lanes(_mm256_loadu_pd(four));
}
inline void store_anywhere(double* four, Lanes a) {
  _mm256_storeu_pd(four, __m256d(a));
}
inline void store(double* four, Lanes a) {
  _mm256_store_pd(four, __m256d(a));
}
inline void store(GrainRecord& r, Lanes a) {
  _mm256_store_pd(&r.x, __m256d(a));
}
/// Changes the sign of the fourth number only: subtracting such records adds what is in `w`.
inline Lanes flip_fourth(Lanes a) {
  return Lanes(_mm256_xor_pd(__m256d(a), _mm256_set_pd(-0.0, 0.0, 0.0, 0.0)));
}
/// Changes the sign of the first three numbers only.
inline Lanes flip_vector(Lanes a) {
  return Lanes(_mm256_xor_pd(__m256d(a), _mm256_set_pd(0.0, -0.0, -0.0, -0.0)));
}
/// Rows become columns: four records to four components, and back.
inline void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const __m256d ab_low = _mm256_unpacklo_pd(__m256d(a), __m256d(b)),
                ab_high = _mm256_unpackhi_pd(__m256d(a), __m256d(b));
  const __m256d cd_low = _mm256_unpacklo_pd(__m256d(c), __m256d(d)),
                cd_high = _mm256_unpackhi_pd(__m256d(c), __m256d(d));
  a = Lanes(_mm256_permute2f128_pd(ab_low, cd_low, 0x20));
  b = Lanes(_mm256_permute2f128_pd(ab_high, cd_high, 0x20));
  c = Lanes(_mm256_permute2f128_pd(ab_low, cd_low, 0x31));
  d = Lanes(_mm256_permute2f128_pd(ab_high, cd_high, 0x31));
}
/// Sum of the lanes in a fixed order.
inline double lane_sum(Lanes a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}
inline double lane_largest(Lanes a) {
  return larger(larger(a[0], a[1]), larger(a[2], a[3]));
}

}  // namespace standoff::particles
