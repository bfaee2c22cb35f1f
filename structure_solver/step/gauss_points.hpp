#pragma once
// How the metal answers at all Gauss points of one element, or of four side by side (T = Pack4).
//
// DATA LAYOUT  gradient: T[3][3][points] (component, direction, point), the displacement gradient H, overwritten by the
// first Piola-Kirchhoff stress P     history: T[points][Law::fields], written only if `commit`
#include "structure_solver/materials/finite_strain_metal.hpp"

namespace standoff::structure {

/// Of the history of a point, with every effect on.
inline constexpr int most_fields = Metal<Hardening::power, RateLaw::power, true, true>::fields;

template <class T>
struct ElementSums {
  T elastic, inelastic;  // J: stored now; work on plastic and thermal strain in this step
  MaskOf<T> sound;       // det F > 0 and finite at every point
};

template <class Law, class T>
inline PointHistory<T> load_history(const MetalParameters& metal, const T* field) {
  PointHistory<T> s;
  s.strain = T(0.0);
  if constexpr (Law::plasticity) {
    s.c = {field[0], field[1], field[2], field[3], field[4], field[5]};
    s.strain = field[Law::strain_field];
  }
  s.temperature = T(metal.flow.room_temperature);
  s.static_stress = T(metal.flow.A);
  s.x = T(0.0);
  if constexpr (Law::temperature_field >= 0) s.temperature = field[Law::temperature_field];
  if constexpr (Law::static_stress_field >= 0) s.static_stress = field[Law::static_stress_field];
  if constexpr (Law::x_field >= 0) s.x = field[Law::x_field];
  return s;
}

template <class Law, class T>
inline void store_history(const PointHistory<T>& s, T* field) {
  field[0] = s.c.xx, field[1] = s.c.yy, field[2] = s.c.zz, field[3] = s.c.xy, field[4] = s.c.yz, field[5] = s.c.zx;
  field[Law::strain_field] = s.strain;
  if constexpr (Law::temperature_field >= 0) field[Law::temperature_field] = s.temperature;
  if constexpr (Law::static_stress_field >= 0) field[Law::static_stress_field] = s.static_stress;
  if constexpr (Law::x_field >= 0) field[Law::x_field] = s.x;
}

template <class T>
inline Mat3<T> load_gradient(const T* gradient, int points, int q) {
  Mat3<T> h;
  for (int k = 0; k < 9; ++k) h.m[k / 3][k % 3] = gradient[k * points + q];
  return h;
}

template <class T, std::size_t Points>
inline Mat3<T> load_gradient(const T (&gradient)[3][3][Points], int q) {
  return load_gradient(&gradient[0][0][0], static_cast<int>(Points), q);
}

template <class T>
inline void store_gradient(const Mat3<T>& h, T* gradient, int points, int q) {
  for (int k = 0; k < 9; ++k) gradient[k * points + q] = h.m[k / 3][k % 3];
}

/// Stress at every point, and the sums weighted by `weight`, m3 of reference volume. Flattened: a point as a function
/// of its own would hand its tensors over in memory, a tenth of the time.
template <class Law, class T>
[[gnu::flatten]] inline ElementSums<T> update_points(const MetalParameters& metal, const PointStep& step, bool commit,
                                                     int points, const double* weight, T* gradient, T* history) {
  ElementSums<T> sums{T(0.0), T(0.0), Lanes<T>::all_true()};
  for (int q = 0; q < points; ++q) {
    T* const fields = history + q * Law::fields;
    PointHistory<T> s = load_history<Law>(metal, fields);
    const PointResult<T> point = update_point<Law>(metal, load_gradient(gradient, points, q), step, s);
    if constexpr (Law::plasticity)
      if (commit && any(point.flowed)) store_history<Law>(s, fields);
    sums.elastic = fused(T(weight[q]), point.elastic, sums.elastic);
    sums.inelastic = fused(T(weight[q]), point.inelastic, sums.inelastic);
    sums.sound = sums.sound & (point.volume_ratio > T(0.0));
    store_gradient(point.p, gradient, points, q);
  }
  return sums;
}

}  // namespace standoff::structure
