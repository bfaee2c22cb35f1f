#pragma once
// One source for scalar and vector arithmetic: kernels are templates on the number type, `double` (one element) or
// `Pack4` (four elements side by side in one AVX2 register). Both run the same operations in the same order, so a lane
// of a pack holds the bits that the scalar kernel would give.
//
//   Pack4   | element a | element b | element c | element d |    32 bytes; Mask4 holds all-ones or zero per lane
//
// The build forbids silent contraction, so fused multiply-adds are written out as fused(a, b, c) = a * b + c.
#include <bit>
#include <cmath>
#include <cstdint>

#include <immintrin.h>

namespace standoff::structure {

struct Mask4 {
  using Raw = long long __attribute__((vector_size(32)));
  Raw raw;
  friend Mask4 operator&(Mask4 a, Mask4 b) { return {a.raw & b.raw}; }
  friend Mask4 operator|(Mask4 a, Mask4 b) { return {a.raw | b.raw}; }
  friend Mask4 operator~(Mask4 a) { return {~a.raw}; }
};

struct Pack4 {
  using Raw = double __attribute__((vector_size(32)));
  Raw raw;
  Pack4() = default;
  Pack4(double s) : raw{s, s, s, s} {}
  explicit Pack4(Raw r) : raw(r) {}
  Pack4& operator+=(Pack4 b) { return raw += b.raw, *this; }
  Pack4& operator-=(Pack4 b) { return raw -= b.raw, *this; }
  Pack4& operator*=(Pack4 b) { return raw *= b.raw, *this; }
  friend Pack4 operator+(Pack4 a, Pack4 b) { return Pack4(a.raw + b.raw); }
  friend Pack4 operator-(Pack4 a, Pack4 b) { return Pack4(a.raw - b.raw); }
  friend Pack4 operator*(Pack4 a, Pack4 b) { return Pack4(a.raw * b.raw); }
  friend Pack4 operator/(Pack4 a, Pack4 b) { return Pack4(a.raw / b.raw); }
  friend Pack4 operator-(Pack4 a) { return Pack4(-a.raw); }
  friend Mask4 operator<(Pack4 a, Pack4 b) { return {a.raw < b.raw}; }
  friend Mask4 operator<=(Pack4 a, Pack4 b) { return {a.raw <= b.raw}; }
  friend Mask4 operator>(Pack4 a, Pack4 b) { return {a.raw > b.raw}; }
};

template <class T>
struct Lanes;

template <>
struct Lanes<double> {
  static constexpr int count = 1;
  using Mask = bool;
  using Bits = std::uint64_t;
  static constexpr Mask all_true() { return true; }
  static constexpr Mask all_false() { return false; }
};

template <>
struct Lanes<Pack4> {
  static constexpr int count = 4;
  using Mask = Mask4;
  using Bits = unsigned long long __attribute__((vector_size(32)));
  static Mask all_true() { return {Mask4::Raw{-1, -1, -1, -1}}; }
  static Mask all_false() { return {Mask4::Raw{0, 0, 0, 0}}; }
};

template <class T>
using MaskOf = typename Lanes<T>::Mask;

inline double fused(double a, double b, double c) {
  return __builtin_fma(a, b, c);
}
inline Pack4 fused(Pack4 a, Pack4 b, Pack4 c) {
  return Pack4(Pack4::Raw(_mm256_fmadd_pd(__m256d(a.raw), __m256d(b.raw), __m256d(c.raw))));
}
/// c - a * b
inline double fused_minus(double a, double b, double c) {
  return __builtin_fma(-a, b, c);
}
inline Pack4 fused_minus(Pack4 a, Pack4 b, Pack4 c) {
  return Pack4(Pack4::Raw(_mm256_fnmadd_pd(__m256d(a.raw), __m256d(b.raw), __m256d(c.raw))));
}
inline double square_root(double a) {
  return __builtin_sqrt(a);
}
inline Pack4 square_root(Pack4 a) {
  return Pack4(Pack4::Raw(_mm256_sqrt_pd(__m256d(a.raw))));
}
inline double select(bool m, double a, double b) {
  return m ? a : b;
}
inline Pack4 select(Mask4 m, Pack4 a, Pack4 b) {
  return Pack4(Pack4::Raw(_mm256_blendv_pd(__m256d(b.raw), __m256d(a.raw), __m256d(m.raw))));
}
inline bool any(bool m) {
  return m;
}
inline bool any(Mask4 m) {
  return _mm256_movemask_pd(__m256d(m.raw)) != 0;
}
inline bool invert(bool m) {
  return !m;
}
inline Mask4 invert(Mask4 m) {
  return ~m;
}
inline bool lane(bool m, int) {
  return m;
}
inline bool lane(Mask4 m, int i) {
  return (_mm256_movemask_pd(__m256d(m.raw)) >> i & 1) != 0;
}
inline double lane(double a, int) {
  return a;
}
inline double lane(Pack4 a, int i) {
  return a.raw[i];
}
inline void set_lane(double& a, int, double value) {
  a = value;
}
inline void set_lane(Pack4& a, int i, double value) {
  a.raw[i] = value;
}
/// Larger of two; the second if one is not a number, like the machine instruction.
template <class T>
T larger(T a, T b) {
  return select(a > b, a, b);
}
template <class T>
T smaller(T a, T b) {
  return select(a < b, a, b);
}

}  // namespace standoff::structure
