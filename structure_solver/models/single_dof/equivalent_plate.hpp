#pragma once
// A square plate as one spring-mass-yield: w(x, y) = W phi, phi = 1 - max(|x|, |y|) / L the pyramid of four rigid
// triangles that turn about the edges, L half the width. Everything follows from shape and material; nothing is fitted.
//
//   mass        m = rho h int phi^2 = rho h (2 L)^2 / 6                load   int phi = (2 L)^2 / 3
//   hinges      bending along edges and diagonals, moment M0 = A h^2 / 4 per length: force R = 16 M0 (clamped edges),
//               8 M0 (pinned: diagonals alone)        yield lines: Johansen; Biggs, Introduction to Structural Dynamics
//   before      k = 1/3 D / (c (2 L)^2), from the centre of the elastic plate under uniform pressure, w = c q (2L)^4 /
//   D
//               Timoshenko & Woinowsky-Krieger, Theory of Plates and Shells, table 35 and art. 30: c = 0.00126, 0.00406
//   sheet       stretched over its width by the slopes W / L: mean strain of the strips eps = W^2 / (4 L^2) along x and
//               y, stress sigma in both: energy per volume 2 sigma d eps, force V sigma W / L^2, V the plate's volume
//
// Rigid-perfectly plastic, with the velocity 2 V0 that a uniform V0 gives this shape, it comes to rest where
//   m (2 V0)^2 / 2 = 16 M0 W + 2 A h W^2    or    W/h = sqrt(1 + lambda/6) - 1,  lambda = 4 rho V0^2 L^2 / (A h^2):
// the formula of Jones for the clamped square plate, moments and forces limited independently
// (N. Jones, Structural Impact, ch. 7, influence of finite displacements).
//
// Limits: in-plane stretch is the same everywhere, so strains are means and the shape of the load counts only through
// int phi; yield is square (M and N apart), an upper bound of strength; no travelling hinge, no wave; the first
// frequency is 10.5 % high (clamped), as k is exact for the static deflection and phi is not the mode.
#include "coupling/case/case_spec.hpp"

namespace standoff::structure {

struct EquivalentPlate {
  double half = 0.0;               // L, m
  double volume = 0.0;             // m3
  double mass = 0.0;               // m, kg: kinetic energy is m W'^2 / 2
  double momentum = 0.0;           // rho h int phi, kg: momentum is that times W'
  double hinge_force = 0.0;        // R, N
  double bending_stiffness = 0.0;  // k, N/m

  double phi(const Vec3& x) const {
    const double ax = x.x < 0.0 ? -x.x : x.x, ay = x.y < 0.0 ? -x.y : x.y;
    return 1.0 - (ax > ay ? ax : ay) / half;
  }
  double strain(double w) const { return w * w / (4.0 * half * half); }
  /// Force on W of the stress sigma in both directions of the sheet.
  double sheet_force(double stress, double w) const { return volume * stress * w / (half * half); }
};

/// Of the simulated part: a quarter carries a quarter of everything.
inline EquivalentPlate equivalent_plate(const CaseSpec& spec) {
  const PlateSpec& p = spec.plate;
  const MaterialSpec& m = p.material;
  const bool clamped = p.edges == "clamped";
  const double width = p.size.x, h = p.size.z, part = 1.0 / spec.copies();
  const double rigidity = m.youngs_modulus * h * h * h / (12.0 * (1.0 - m.poissons_ratio * m.poissons_ratio));
  const double moment = 0.25 * m.A * h * h;
  EquivalentPlate e;
  e.half = 0.5 * width;
  e.volume = part * width * width * h;
  e.mass = m.density * e.volume / 6.0;
  e.momentum = m.density * e.volume / 3.0;
  e.hinge_force = part * (clamped ? 16.0 : 8.0) * moment;
  e.bending_stiffness = part * rigidity / (3.0 * (clamped ? 0.00126532 : 0.00406235) * width * width);
  return e;
}

}  // namespace standoff::structure
