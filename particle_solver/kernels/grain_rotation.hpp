#pragma once
// Turning of rough spheres: spin slides surfaces along each other, and the force along the tangent turns the spheres.
// The law of the force itself does not change (grain_contact.hpp, surface_impact.hpp, surface_spring.hpp): it sees the
// slip of the surfaces instead of that of the centres.
//
// Two grains, d = x_i - x_j, n = d/|d|, reach = r_i + r_j. Lever of i: a_i = r_i |d| / reach, from its centre to the
// point of contact, so that a_i + a_j = |d|:
//   slip of the surfaces   u = v_i - v_j - (a_i w_i + a_j w_j) x n = v_i - v_j - (r_i w_i + r_j w_j) x d / reach
//   torque on i            T_i = -a_i n x f_i = r_i (f_i x d) / reach;  on j: T_j = r_j (f_i x d) / reach
//   spin                   I dw/dt = T,  I = 2/5 m r^2, a solid sphere
// Source: Cundall & Strack, Geotechnique 29 (1979) 47; Brilliantov et al., Phys. Rev. E 53 (1996) 5382. Deviations:
// their levers are the radii; here levers end at the point of contact, which is what keeps the angular momentum x x m v
// + I w of a pair exact: T_i + T_j + d x f_i = 0. The spin of a pair about its own normal neither slides nor turns
// anything (no torsion), and there is no rolling resistance.
//
// At rest against each other, surfaces are moved by a tangential force with 2/7 of the mass: 1/m + r^2/I = 7/(2 m).
// A mirror image turns by (w_x, -w_y, -w_z) at a plane across x (spin is an axial vector): both surfaces move alike, so
// a contact with the own image neither slides nor turns.
//
// Stability: with k along the tangent, the row sum of grain_contact.hpp grows 7/2 times, dt < 2 sqrt(m/k)/sqrt(7 z)
// with z contacts. The step of SandPairs::stable_step, at most a quarter of sqrt(2 m/(z k)), is 0.47 of that.
//
// w rad/s, T N m, I kg m^2, lengths m. Number type: double, or Lanes for four pairs at once.
#include "particle_solver/kernels/grain_contact.hpp"

namespace standoff::particles {

template <class Real>
inline Triple<Real> cross(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Slip of the surfaces from that of the centres. `turns` = (r_i w_i + r_j w_j) dt [m]; slip i against j [m].
template <class Real>
inline Triple<Real> surface_slip(const Triple<Real>& slip, const Triple<Real>& turns, const Triple<Real>& separation,
                                 const Real& per_reach) {
  return add_scaled(slip, -per_reach, cross(turns, separation));
}

/// Torque over radius [N], the same for i and j. `force` on i.
template <class Real>
inline Triple<Real> torque_over_radius(const Triple<Real>& force, const Triple<Real>& separation,
                                       const Real& per_reach) {
  const Triple<Real> arm = cross(force, separation);
  return {arm.x * per_reach, arm.y * per_reach, arm.z * per_reach};
}

}  // namespace standoff::particles
