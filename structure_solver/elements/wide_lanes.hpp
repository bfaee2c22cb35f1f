#pragma once
// `Pack8`: two Pack4 side by side in one AVX-512 register, with the interface of lanes.hpp. For files compiled for
// AVX-512 alone.
#include "structure_solver/elements/lanes.hpp"

namespace standoff::structure {

struct Mask8 {
  __mmask8 raw;
  friend Mask8 operator&(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.raw & b.raw)}; }
  friend Mask8 operator|(Mask8 a, Mask8 b) { return {static_cast<__mmask8>(a.raw | b.raw)}; }
  friend Mask8 operator~(Mask8 a) { return {static_cast<__mmask8>(~a.raw)}; }
};

struct Pack8 {
  using Raw = double __attribute__((vector_size(64)));
  Raw raw;
  Pack8() = default;
  Pack8(double s) : raw{s, s, s, s, s, s, s, s} {}
  explicit Pack8(Raw r) : raw(r) {}
  __m512d machine() const { return __m512d(raw); }
  Pack8& operator+=(Pack8 b) { return raw += b.raw, *this; }
  Pack8& operator-=(Pack8 b) { return raw -= b.raw, *this; }
  Pack8& operator*=(Pack8 b) { return raw *= b.raw, *this; }
  friend Pack8 operator+(Pack8 a, Pack8 b) { return Pack8(a.raw + b.raw); }
  friend Pack8 operator-(Pack8 a, Pack8 b) { return Pack8(a.raw - b.raw); }
  friend Pack8 operator*(Pack8 a, Pack8 b) { return Pack8(a.raw * b.raw); }
  friend Pack8 operator/(Pack8 a, Pack8 b) { return Pack8(a.raw / b.raw); }
  friend Pack8 operator-(Pack8 a) { return Pack8(-a.raw); }
  friend Mask8 operator<(Pack8 a, Pack8 b) { return {_mm512_cmp_pd_mask(a.machine(), b.machine(), _CMP_LT_OQ)}; }
  friend Mask8 operator<=(Pack8 a, Pack8 b) { return {_mm512_cmp_pd_mask(a.machine(), b.machine(), _CMP_LE_OQ)}; }
  friend Mask8 operator>(Pack8 a, Pack8 b) { return {_mm512_cmp_pd_mask(a.machine(), b.machine(), _CMP_GT_OQ)}; }
};

template <>
struct Lanes<Pack8> {
  static constexpr int count = 8;
  using Mask = Mask8;
  using Bits = unsigned long long __attribute__((vector_size(64)));
  static Mask all_true() { return {0xff}; }
  static Mask all_false() { return {0}; }
};

inline Pack8 fused(Pack8 a, Pack8 b, Pack8 c) {
  return Pack8(_mm512_fmadd_pd(a.machine(), b.machine(), c.machine()));
}
/// c - a * b
inline Pack8 fused_minus(Pack8 a, Pack8 b, Pack8 c) {
  return Pack8(_mm512_fnmadd_pd(a.machine(), b.machine(), c.machine()));
}
inline Pack8 square_root(Pack8 a) {
  return Pack8(_mm512_maskz_sqrt_pd(0xff, a.machine()));
}
inline Pack8 select(Mask8 m, Pack8 a, Pack8 b) {
  return Pack8(_mm512_mask_blend_pd(m.raw, b.machine(), a.machine()));
}
inline bool any(Mask8 m) {
  return m.raw != 0;
}
inline Mask8 invert(Mask8 m) {
  return ~m;
}
inline bool lane(Mask8 m, int i) {
  return (m.raw >> i & 1) != 0;
}
inline double lane(Pack8 a, int i) {
  return a.raw[i];
}
inline void set_lane(Pack8& a, int i, double value) {
  a.raw[i] = value;
}

inline Pack8 joined(Pack4 low, Pack4 high) {
  return Pack8(__builtin_shufflevector(low.raw, high.raw, 0, 1, 2, 3, 4, 5, 6, 7));
}
inline Pack4 lower(Pack8 a) {
  return Pack4(__builtin_shufflevector(a.raw, a.raw, 0, 1, 2, 3));
}
inline Pack4 upper(Pack8 a) {
  return Pack4(__builtin_shufflevector(a.raw, a.raw, 4, 5, 6, 7));
}

}  // namespace standoff::structure
