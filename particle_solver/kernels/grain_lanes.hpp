#pragma once
// Four doubles side by side, so that a law written once for a number type runs on one pair or on four pairs at a time.
//
// Kernels use + - * / and the five functions below; they are given here for `double` and for `Lanes`. Each lane
// performs the same IEEE operations as the scalar version, so both give the same bits. The only file of the sand with
// instructions in it.
#include <cmath>

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

inline Lanes all_lanes(double a) {
  return Lanes{a, a, a, a};
}
inline Lanes load(const GrainRecord& r) {
  return Lanes(_mm256_load_pd(&r.x));
}
inline Lanes load(const double* four) {
  return Lanes(_mm256_load_pd(four));
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
