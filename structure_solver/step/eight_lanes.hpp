#pragma once
// Definition behind eight_lane_update of point_laws.hpp: two Gauss points of four elements in one AVX-512 register.
// Flow is a chain of dependent operations; twice the lanes are nearly twice the points in the same time.
// Included only by the files that instantiate it, which alone are compiled for AVX-512: what else they share with the
// rest of the program must be inlined, or an older processor would meet it (tests/house/check_eight_lanes.py).
#include "structure_solver/elements/wide_lanes.hpp"
#include "structure_solver/step/point_laws.hpp"

namespace standoff::structure {

/// update_points, point q in the lower and q + 1 in the upper half; the last of an odd number stands in both.
template <class Law>
[[gnu::flatten]] ElementSums<Pack4> update_pairs(const MetalParameters& metal, const PointStep& step, bool commit,
                                                 int points, const double* weight, Pack4* gradient, Pack4* history) {
  ElementSums<Pack4> sums{Pack4(0.0), Pack4(0.0), Lanes<Pack4>::all_true()};
  for (int q = 0; q < points; q += 2) {
    const int r = q + 1 < points ? q + 1 : q;
    Pack4 *const low = history + q * Law::fields, *const high = history + r * Law::fields;
    Pack8 fields[Law::fields];
    for (int k = 0; k < Law::fields; ++k) fields[k] = joined(low[k], high[k]);
    Mat3<Pack8> h;
    for (int k = 0; k < 9; ++k) h.m[k / 3][k % 3] = joined(gradient[k * points + q], gradient[k * points + r]);
    PointHistory<Pack8> s = load_history<Law>(metal, fields);
    const PointResult<Pack8> point = update_point<Law>(metal, h, step, s);
    if (commit && any(point.flowed)) {
      store_history<Law>(s, fields);
      for (int k = 0; k < Law::fields; ++k) high[k] = upper(fields[k]), low[k] = lower(fields[k]);
    }
    for (int k = 0; k < 9; ++k) {
      gradient[k * points + r] = upper(point.p.m[k / 3][k % 3]);
      gradient[k * points + q] = lower(point.p.m[k / 3][k % 3]);
    }
    sums.elastic = fused(Pack4(weight[q]), lower(point.elastic), sums.elastic);
    sums.inelastic = fused(Pack4(weight[q]), lower(point.inelastic), sums.inelastic);
    sums.sound = sums.sound & (lower(point.volume_ratio) > Pack4(0.0)) & (upper(point.volume_ratio) > Pack4(0.0));
    if (r == q) break;
    sums.elastic = fused(Pack4(weight[r]), upper(point.elastic), sums.elastic);
    sums.inelastic = fused(Pack4(weight[r]), upper(point.inelastic), sums.inelastic);
  }
  return sums;
}

template <RateLaw Rate>
PointUpdate eight_lane_update(const MetalEffects& effects) {
  return with_metal<Rate>(effects, []<class Law>() -> PointUpdate { return &update_pairs<Law>; });
}

}  // namespace standoff::structure
