#pragma once
// The bilinear quad: four corners in space, straight edges, a doubly ruled patch between them.
//
//   S(xi, eta) = c + a xi + b eta + d xi eta,  xi, eta in [-1, 1]      corners 0..3 at (-1,-1) (1,-1) (1,1) (-1,1)
//   weights N_i = (1 + xi xi_i)(1 + eta eta_i) / 4, sum N_i = 1, sum N_i x_i = S        [Hughes, The Finite Element
//   Method, 3.2]
//
// Foot of a position p: the minimum of f = |S - p|^2 / 2 on the square. Interior by Newton with the exact Hessian
//   f_x = (S-p).S_x,  H = [ S_x.S_x,  S_x.S_e + (S-p).d ;  .,  S_e.S_e ],   S_x = a + d eta,  S_e = b + d xi,
// exact in one step on a parallelogram (d = 0) and quadratic else, with error constant about |d| / |S_x|; on the border
// the edges are straight and the foot is closed form. A border point is kept only if the descent there points outwards.
// Valid for convex quads and positions nearer than the patch's radius of curvature (|p - S| |d| < |S_x| |S_e|).
// Units: all lengths in m; xi, eta without unit.
#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/base/vec3.hpp"

namespace standoff::particles {

struct BilinearQuad {
  Vec3 centre, along_xi, along_eta, twist;  // c, a, b, d

  Vec3 point(double xi, double eta) const { return centre + along_xi * xi + (along_eta + twist * xi) * eta; }
  Vec3 tangent_xi(double eta) const { return along_xi + twist * eta; }
  Vec3 tangent_eta(double xi) const { return along_eta + twist * xi; }
  /// Unit normal, to the side from which the corners run counter-clockwise.
  Vec3 normal(double xi, double eta) const {
    const Vec3 n = cross(tangent_xi(eta), tangent_eta(xi));
    return n / norm(n);
  }
};

inline BilinearQuad bilinear_quad(const std::array<Vec3, 4>& x) {
  const Vec3 s02 = x[0] + x[2], s13 = x[1] + x[3], d20 = x[2] - x[0], d13 = x[1] - x[3];
  return {(s02 + s13) * 0.25, (d20 + d13) * 0.25, (d20 - d13) * 0.25, (s02 - s13) * 0.25};
}

inline std::array<double, 4> bilinear_weights(double xi, double eta) {
  const double a = 0.5 * (1.0 - xi), b = 0.5 * (1.0 + xi), c = 0.5 * (1.0 - eta), d = 0.5 * (1.0 + eta);
  return {a * c, b * c, b * d, a * d};
}

/// Closest point of a quad. `border` has bit e set if the foot lies on edge e: 0 eta=-1, 1 xi=1, 2 eta=1, 3 xi=-1.
struct QuadFoot {
  double xi = 0.0, eta = 0.0, squared_distance = 0.0;
  unsigned border = 0;
};

/// Newton from (xi, eta) for the quad seen from the origin; false if the stationary point is not inside the square.
inline bool quad_interior_foot(const BilinearQuad& q, double& xi, double& eta) {
  const double twist2 = squared_norm(q.twist);
  for (int i = 0; i < 16; ++i) {
    const Vec3 tx = q.tangent_xi(eta), te = q.tangent_eta(xi), s = q.centre + q.along_xi * xi + te * eta;
    const double gx = dot(s, tx), ge = dot(s, te), hxx = dot(tx, tx), hee = dot(te, te), mixed = dot(tx, te);
    double hxe = mixed + dot(s, q.twist), det = hxx * hee - hxe * hxe;
    if (det < 0.05 * hxx * hee) hxe = mixed, det = hxx * hee - mixed * mixed;  // not convex here: Gauss-Newton
    if (!(det > 0.0)) return false;
    const double inverse = 1.0 / det, dx = (hee * gx - hxe * ge) * inverse, de = (hxx * ge - hxe * gx) * inverse;
    xi -= dx, eta -= de;
    if (!(std::abs(xi) < 4.0 && std::abs(eta) < 4.0)) return false;
    const double step2 = dx * dx + de * de;  // the error left is about 2 |d| / |S_x| step^2
    if (4.0 * twist2 * step2 * step2 < 1e-31 * std::min(hxx, hee)) break;
  }
  return std::abs(xi) <= 1.0 && std::abs(eta) <= 1.0;
}

/// Foot on the border of the quad seen from the origin.
inline QuadFoot quad_border_foot(const std::array<Vec3, 4>& x) {
  QuadFoot best;
  int edge = -1;
  double along = 0.0;
  for (int e = 0; e < 4; ++e) {
    const Vec3& from = x[static_cast<std::size_t>(e)];
    const Vec3 side = x[static_cast<std::size_t>((e + 1) & 3)] - from;
    const double s = std::clamp(-dot(from, side) / std::max(squared_norm(side), 1e-300), 0.0, 1.0);
    const double d2 = squared_norm(from + side * s);
    if (edge < 0 || d2 < best.squared_distance) edge = e, along = s, best.squared_distance = d2;
  }
  const double u = 2.0 * along - 1.0;
  best.xi = edge == 0 ? u : edge == 1 ? 1.0 : edge == 2 ? -u : -1.0;
  best.eta = edge == 0 ? -1.0 : edge == 1 ? u : edge == 2 ? 1.0 : -u;
  best.border = (best.eta == -1.0 ? 1u : 0u) | (best.xi == 1.0 ? 2u : 0u) | (best.eta == 1.0 ? 4u : 0u) |
                (best.xi == -1.0 ? 8u : 0u);
  return best;
}

/// Foot of `position` on the quad with corners `corner`.
inline QuadFoot quad_foot(std::array<Vec3, 4> corner, const Vec3& position) {
  for (Vec3& c : corner) c -= position;  // seen from the position: no digits lost to large coordinates
  const BilinearQuad q = bilinear_quad(corner);
  QuadFoot inside;
  if (quad_interior_foot(q, inside.xi, inside.eta)) {
    inside.squared_distance = squared_norm(q.point(inside.xi, inside.eta));
    return inside;
  }
  const QuadFoot border = quad_border_foot(corner);
  const Vec3 s = q.point(border.xi, border.eta);
  const double gx = dot(s, q.tangent_xi(border.eta)), ge = dot(s, q.tangent_eta(border.xi));
  const bool descends_inwards = (border.border & 2u && gx > 0.0) || (border.border & 8u && gx < 0.0) ||
                                (border.border & 4u && ge > 0.0) || (border.border & 1u && ge < 0.0);
  if (!descends_inwards) return border;
  inside.xi = 0.9 * border.xi, inside.eta = 0.9 * border.eta;  // Newton lost its way from the centre: try from here
  if (!quad_interior_foot(q, inside.xi, inside.eta)) return border;
  inside.squared_distance = squared_norm(q.point(inside.xi, inside.eta));
  return inside.squared_distance < border.squared_distance ? inside : border;
}

}  // namespace standoff::particles
