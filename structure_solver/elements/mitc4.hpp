#pragma once
// Kinematics of the 4-node shell MITC4: Dvorkin & Bathe, Eng. Comput. 1 (1984) 77, for a mid-surface that is flat at
// rest (z = 0) and directors d that stand on it. The four Gauss points in the plane are the four lanes of a Pack4.
//
//   3 ---- 2      x(z) = sum_I N_I (X_I + u_I + z d_I),  d_I = e_z + lean_I, |d_I| = 1, z from the mid-surface at rest
//   |      |      in the lamina   C_ab = a_a . a_b,  a_a = d(x)/dX_a
//   0 ---- 1      across it       C_a3 from the edges: gamma_e = 1/4 (x_b - x_a).(d_a + d_b) is constant along edge
//                                 a-b and linear between opposite edges, which keeps thin shells from locking
//
// Everything is counted from the shape at rest as small terms, so tiny strains keep their digits. Not modelled: the
// change of z with the thickness (bending keeps the lever arms at rest) and a rotation about d, which has no stiffness
// and no degree of freedom.
#include <array>

#include "coupling/base/vec3.hpp"
#include "structure_solver/elements/lanes.hpp"

namespace standoff::structure {

inline constexpr int shell_nodes = 4;
using Vec3Lanes = std::array<Pack4, 3>;

inline Pack4 dot(const Vec3Lanes& a, const Vec3Lanes& b) {
  return fused(a[0], b[0], fused(a[1], b[1], a[2] * b[2]));
}

inline double sum_of_lanes(Pack4 a) {
  return ((lane(a, 0) + lane(a, 1)) + lane(a, 2)) + lane(a, 3);
}

/// An edge that carries a shear strain: nodes, direction (0: xi, 1: eta) and its share at the Gauss points.
struct ShearEdge {
  std::size_t a, b, direction;
  Pack4 share;
};

inline const std::array<ShearEdge, 4>& shear_edges() {
  constexpr double near = 0.5 * (1.0 + 0.57735026918962576), far = 1.0 - near;
  static const std::array<ShearEdge, 4> edges{{{0, 1, 0, Pack4(Pack4::Raw{near, near, far, far})},
                                               {3, 2, 0, Pack4(Pack4::Raw{far, far, near, near})},
                                               {0, 3, 1, Pack4(Pack4::Raw{near, far, far, near})},
                                               {1, 2, 1, Pack4(Pack4::Raw{far, near, near, far})}}};
  return edges;
}

/// A quad at rest: what the four Gauss points need of it.
struct ShellGeometry {
  std::array<std::array<Pack4, 2>, 4> gradient;  // dN_I/dX_a, 1/m
  std::array<std::array<Pack4, 2>, 2> inverse;   // [a][i] d xi_i / d X_a, 1/m
  Pack4 area;                                    // of each Gauss point, m2
  std::array<Vec3, 4> along;                     // X_b - X_a of the shear edges, m

  static ShellGeometry of_nodes(const std::array<Vec3, 4>& at) {
    ShellGeometry g;
    constexpr double gauss = 0.57735026918962576, corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (std::size_t q = 0; q < 4; ++q) {
      const double xi = gauss * corner[q][0], eta = gauss * corner[q][1];
      double n[4][2], jacobian[2][2] = {{0.0, 0.0}, {0.0, 0.0}};  // [i][a] dX_a / d xi_i
      for (std::size_t a = 0; a < 4; ++a) {
        n[a][0] = 0.25 * corner[a][0] * (1.0 + eta * corner[a][1]);
        n[a][1] = 0.25 * corner[a][1] * (1.0 + xi * corner[a][0]);
        for (std::size_t i = 0; i < 2; ++i) jacobian[i][0] += n[a][i] * at[a].x, jacobian[i][1] += n[a][i] * at[a].y;
      }
      const double det = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
      const double inverse[2][2] = {{jacobian[1][1] / det, -jacobian[0][1] / det},
                                    {-jacobian[1][0] / det, jacobian[0][0] / det}};
      g.area.raw[q] = det;
      for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t i = 0; i < 2; ++i) {
          g.inverse[a][i].raw[q] = inverse[a][i];
          for (std::size_t node = 0; node < 4; ++node)
            g.gradient[node][a].raw[q] = inverse[a][0] * n[node][0] + inverse[a][1] * n[node][1];
        }
    }
    for (std::size_t e = 0; e < 4; ++e) g.along[e] = at[shear_edges()[e].b] - at[shear_edges()[e].a];
    return g;
  }

  /// d(values)/dX_a at the Gauss points.
  Vec3Lanes slope(const std::array<Vec3, 4>& values, std::size_t a) const {
    Vec3Lanes sum{Pack4(0.0), Pack4(0.0), Pack4(0.0)};
    for (std::size_t n = 0; n < 4; ++n) {
      sum[0] = fused(gradient[n][a], Pack4(values[n].x), sum[0]);
      sum[1] = fused(gradient[n][a], Pack4(values[n].y), sum[1]);
      sum[2] = fused(gradient[n][a], Pack4(values[n].z), sum[2]);
    }
    return sum;
  }
};

/// How a quad is deformed: displacements of its nodes and directors less e_z.
struct ShellMotion {
  std::array<Vec3, 4> u, lean;
};

/// d_a + d_b of a shear edge.
inline Vec3 directors(const ShellMotion& m, const ShearEdge& edge) {
  return m.lean[edge.a] + m.lean[edge.b] + Vec3{0.0, 0.0, 2.0};
}

/// Transverse shear C_13, C_23 at the Gauss points.
inline std::array<Pack4, 2> transverse_shear(const ShellGeometry& g, const ShellMotion& m) {
  std::array<Pack4, 2> shear{Pack4(0.0), Pack4(0.0)};
  for (std::size_t e = 0; e < 4; ++e) {
    const ShearEdge& edge = shear_edges()[e];
    const double strain = 0.25 * (standoff::dot(g.along[e], m.lean[edge.a] + m.lean[edge.b]) +
                                  standoff::dot(m.u[edge.b] - m.u[edge.a], directors(m, edge)));
    for (std::size_t a = 0; a < 2; ++a)
      shear[a] = fused(edge.share * g.inverse[a][edge.direction], Pack4(strain), shear[a]);
  }
  return shear;
}

/// What resists: forces on the nodes, and on their directors per unit of d.
struct ShellForces {
  std::array<Vec3, 4> force, couple;  // N, N m
};

/// Stress resultants per area at rest: along the lamina (vector per direction a), times z, and across it.
struct ShellResultants {
  std::array<Vec3Lanes, 2> membrane, moment;  // N/m, N
  std::array<Pack4, 2> shear;                 // N/m
};

/// The adjoint of the strains: same geometry, same motion.
inline ShellForces nodal_forces(const ShellGeometry& g, const ShellMotion& m, const ShellResultants& r) {
  ShellForces f{};
  for (std::size_t n = 0; n < 4; ++n)
    for (std::size_t a = 0; a < 2; ++a) {
      const Pack4 weight = g.gradient[n][a] * g.area;
      f.force[n] += Vec3{sum_of_lanes(weight * r.membrane[a][0]), sum_of_lanes(weight * r.membrane[a][1]),
                         sum_of_lanes(weight * r.membrane[a][2])};
      f.couple[n] += Vec3{sum_of_lanes(weight * r.moment[a][0]), sum_of_lanes(weight * r.moment[a][1]),
                          sum_of_lanes(weight * r.moment[a][2])};
    }
  for (std::size_t e = 0; e < 4; ++e) {
    const ShearEdge& edge = shear_edges()[e];
    const std::size_t i = edge.direction;
    const double q =
        0.25 * sum_of_lanes(g.area * edge.share * (g.inverse[0][i] * r.shear[0] + g.inverse[1][i] * r.shear[1]));
    const Vec3 pull = q * directors(m, edge), turn = q * (g.along[e] + m.u[edge.b] - m.u[edge.a]);
    f.force[edge.a] += -1.0 * pull, f.force[edge.b] += pull;
    f.couple[edge.a] += turn, f.couple[edge.b] += turn;
  }
  return f;
}

}  // namespace standoff::structure
