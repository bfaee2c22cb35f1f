#pragma once
// Resisting force of one shell: strains of mitc4.hpp, metal of plane_stress.hpp at five Gauss points through the
// thickness, summed to resultants.
//   C_ab(z) = a_a . a_b,  a_a = e_a + u,a + z d,a;   C_a3 = sqrt(kappa) gamma_a, kappa = 5/6 for the parabola of shear
// kappa enters strain and force alike, so the force is the gradient of the stored energy.
//
// DATA LAYOUT  history: Pack4[5 layers][Law::fields + 1], lane = Gauss point in the plane, last field the thickness
// stretch. It is the starting point of the next plane stress solution and the thickness that is shown.
#include "structure_solver/elements/mitc4.hpp"
#include "structure_solver/materials/plane_stress.hpp"
#include "structure_solver/step/gauss_points.hpp"

namespace standoff::structure {

inline constexpr int shell_layers = 5;
/// Gauss-Legendre on [-1, 1].
inline constexpr double layer_place[shell_layers] = {-0.90617984593866399, -0.53846931010568309, 0.0,
                                                     0.53846931010568309, 0.90617984593866399};
inline constexpr double layer_weight[shell_layers] = {0.23692688505618909, 0.47862867049936647, 0.56888888888888889,
                                                      0.47862867049936647, 0.23692688505618909};
inline constexpr double shear_factor = 0.91287092917527686;  // sqrt(5/6)

struct ShellSums {
  double elastic, inelastic;  // J: stored now; work on plastic and thermal strain in this step
  bool sound;                 // right way up, det F > 0, finite and without normal stress at every point
};

/// Slopes of displacement and director at the Gauss points, and the shear between them.
struct ShellSlopes {
  std::array<Vec3Lanes, 2> u, lean;
  std::array<Pack4, 2> shear;

  ShellSlopes(const ShellGeometry& g, const ShellMotion& m)
      : u{g.slope(m.u, 0), g.slope(m.u, 1)},
        lean{g.slope(m.lean, 0), g.slope(m.lean, 1)},
        shear(transverse_shear(g, m)) {}

  /// a_a - e_a at height z.
  std::array<Vec3Lanes, 2> lamina(double z) const {
    std::array<Vec3Lanes, 2> a;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t c = 0; c < 3; ++c) a[i][c] = fused(Pack4(z), lean[i][c], u[i][c]);
    return a;
  }
  Lamina<Pack4> strain(const std::array<Vec3Lanes, 2>& a) const {
    return {a[0][0] + a[0][0] + dot(a[0], a[0]), a[1][1] + a[1][1] + dot(a[1], a[1]),
            a[0][1] + a[1][0] + dot(a[0], a[1]), Pack4(shear_factor) * shear[1], Pack4(shear_factor) * shear[0]};
  }
};

/// Stress of one lamina, weighted, added to the resultants.
inline void add_layer(ShellResultants& r, const std::array<Vec3Lanes, 2>& a, const Lamina<Pack4>& s, double weight,
                      double z) {
  for (std::size_t c = 0; c < 3; ++c) {
    const Pack4 a1 = a[0][c] + Pack4(c == 0 ? 1.0 : 0.0), a2 = a[1][c] + Pack4(c == 1 ? 1.0 : 0.0);
    const Pack4 t1 = fused(s.xx, a1, s.xy * a2), t2 = fused(s.xy, a1, s.yy * a2);
    r.membrane[0][c] = fused(Pack4(weight), t1, r.membrane[0][c]);
    r.membrane[1][c] = fused(Pack4(weight), t2, r.membrane[1][c]);
    r.moment[0][c] = fused(Pack4(weight * z), t1, r.moment[0][c]);
    r.moment[1][c] = fused(Pack4(weight * z), t2, r.moment[1][c]);
  }
  r.shear[0] = fused(Pack4(weight * shear_factor), s.zx, r.shear[0]);
  r.shear[1] = fused(Pack4(weight * shear_factor), s.yz, r.shear[1]);
}

/// (a_1 x a_2) . d > 0: the mid-surface has not turned over its directors.
inline bool right_way_up(const ShellSlopes& slopes, const ShellMotion& m) {
  const Vec3 d = m.lean[0] + m.lean[1] + m.lean[2] + m.lean[3] + Vec3{0.0, 0.0, 4.0};
  const Vec3Lanes &a = slopes.u[0], &b = slopes.u[1];
  const Pack4 a0 = a[0] + Pack4(1.0), b1 = b[1] + Pack4(1.0);
  const Pack4 along = (a[1] * b[2] - a[2] * b1) * Pack4(d.x) + (a[2] * b[0] - a0 * b[2]) * Pack4(d.y) +
                      (a0 * b1 - a[1] * b[0]) * Pack4(d.z);
  return !any(invert(along > Pack4(0.0)));
}

/// Force from the history, which is written only if `commit`.
template <class Law>
ShellSums shell_force(const MetalParameters& metal, const ShellGeometry& geometry, double thickness,
                      const PointStep& step, bool commit, const ShellMotion& motion, Pack4* history,
                      ShellForces& forces) {
  const ShellSlopes slopes(geometry, motion);
  ShellResultants resultants{};
  Pack4 elastic(0.0), inelastic(0.0);
  MaskOf<Pack4> sound = Lanes<Pack4>::all_true();
  for (int l = 0; l < shell_layers; ++l) {
    const double z = 0.5 * thickness * layer_place[l], weight = 0.5 * thickness * layer_weight[l];
    Pack4* const fields = history + l * (Law::fields + 1);
    PointHistory<Pack4> s = load_history<Law>(metal, fields);
    const std::array<Vec3Lanes, 2> a = slopes.lamina(z);
    const PlaneStress<Pack4> r = update_lamina<Law>(metal, slopes.strain(a), step, fields[Law::fields], s);
    if (commit) {
      if constexpr (Law::plasticity)
        if (any(r.point.flowed)) store_history<Law>(s, fields);
      fields[Law::fields] = r.stretch;
    }
    elastic = fused(Pack4(weight), r.point.elastic, elastic);
    inelastic = fused(Pack4(weight), r.point.inelastic, inelastic);
    sound = sound & r.converged & (r.point.volume_ratio > Pack4(0.0));
    add_layer(resultants, a, r.s, weight, z);
  }
  forces = nodal_forces(geometry, motion, resultants);
  return {sum_of_lanes(geometry.area * elastic), sum_of_lanes(geometry.area * inelastic),
          !any(invert(sound)) && right_way_up(slopes, motion)};
}

/// Von Mises stress [Pa] of every point at the committed history.
template <class Law>
std::array<Pack4, shell_layers> shell_stress(const MetalParameters& metal, const ShellGeometry& geometry,
                                             double thickness, const ShellMotion& motion, const Pack4* history) {
  const ShellSlopes slopes(geometry, motion);
  std::array<Pack4, shell_layers> mises;
  for (int l = 0; l < shell_layers; ++l) {
    const Pack4* const fields = history + l * (Law::fields + 1);
    PointHistory<Pack4> s = load_history<Law>(metal, fields);
    const auto a = slopes.lamina(0.5 * thickness * layer_place[l]);
    mises[static_cast<std::size_t>(l)] =
        von_mises(update_lamina<Law>(metal, slopes.strain(a), PointStep{0.0, false}, fields[Law::fields], s));
  }
  return mises;
}

}  // namespace standoff::structure
