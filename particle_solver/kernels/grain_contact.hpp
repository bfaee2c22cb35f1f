#pragma once
// Contact of two grains, or of a grain with its mirror image: a linear normal spring with a dashpot, and a tangential
// spring of the same stiffness limited by Coulomb friction [Borvik 2011, sec. 3.3]. Grains translate only, as in the
// paper; for those that turn, `slip` is that of their surfaces (grain_rotation.hpp).
//
//   d = x_i - x_j, n = d/|d|, overlap = reach - |d|            reach = r_i + r_j
//   f_n = max(0, k overlap + c closing_speed)                  never attractive, also at the end of a damped contact
//   s'  = s0 turned into the plane across n, length kept;  s1 = s' + slip across n;  s = s1 min(1, mu f_n / (k |s1|))
//   f_i = f_n n - k s,  f_j = -f_i
//   k = (L/L0) k0, L0 = 1 m                                    [Borvik 2011, sec. 3.3], L the size of the cell
//   c = 2 xi sqrt(k m_red), m_red = m_i m_j / (m_i + m_j)
//
// xi is a fraction of the critical damping of the *pair*, whose relative motion has the reduced mass; the paper does
// not say which mass it means (the full mass would make c larger by sqrt 2). With it two free grains part with
//   e = exp(-pi xi / sqrt(1 - xi^2))
// of their approach speed, slightly more because f_n cannot pull. Constant xi is the paper's rule that c grows as
// (L/L0)^2, since k ~ L and m ~ L^3. The spring is capped by mu times the whole f_n (spring and dashpot), so a grazing
// hit gains nothing.
//
// Energy. Velocity Verlet does the work (f_old + f_new)/2 . displacement on the grains. With it, and the displacement
// `slip` of i against j since the last call, exactly:
//   tangential: change of k s^2/2 = work done on the spring - friction_loss, friction_loss = k/2 (s' + s).(s1 - s)
//     (a contact that opens has f_n = 0, hence s = 0: its stored spring is booked as friction loss)
//   dashpot: damping_loss = (f_n - k overlap) closing, which includes the cut at f_n = 0. Short by a relative
//     (omega dt)^2/4 <= 0.5 % of the loss at the recommended step.
//
// Stability: dt < 2 sqrt(m_red/k) = 1.41 sqrt(m/k) for a free pair, sqrt(2 m / (z k)) for z contacts (row sum of the
// stiffness, Gershgorin). Accuracy asks for less: a contact is entered within a step, which shifts energy by up to k (v
// dt)^2/8, so dt = 0.05 * 2 sqrt(m/k) is recommended (SandPairs::stable_step). A dashpot acts with the speed of the
// step before: an error of c dt / m_red of its loss, so dt <= 0.05 m_red / c too; that is the shorter one from xi =
// 0.18 on.
//
// Units: k N/m (> 0), mu >= 0, xi 0..1, lengths m, losses J. Number type: double, or Lanes for four pairs at once. What
// is compiled out costs nothing: without Friction there is no spring, without Damping no loss and no division by dt.
#include "particle_solver/kernels/grain_lanes.hpp"

namespace standoff::particles {

struct GrainLaw {
  double stiffness = 0.0;  // k, N/m, for this size of cell
  double friction = 0.0;   // mu
  double damping = 0.0;    // xi
};

template <class Real>
struct Triple {
  Real x, y, z;
};

template <class Real>
inline Real dot(const Triple<Real>& a, const Triple<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// a + s b
template <class Real>
inline Triple<Real> add_scaled(const Triple<Real>& a, const Real& s, const Triple<Real>& b) {
  return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

/// What a pair knows before the law is asked.
template <class Real>
struct GrainPairInput {
  Triple<Real> separation;  // x_i - x_j, m
  Real reach;               // r_i + r_j, m
  Triple<Real> slip;        // displacement of i against j since the last call, m
  Triple<Real> spring;      // s0, m; zero for a new contact
  Real dashpot_per_step;    // c / dt, N/m; dt of the displacement
};

template <class Real>
struct GrainContact {
  Triple<Real> force;   // N on i
  Triple<Real> spring;  // s, m
  Real overlap;         // m, >= 0
  Real elastic;         // J stored now, normal and tangential
  Real friction_loss;   // J in this step
  Real damping_loss;    // J in this step
};

/// The tangential part; `pressed` is f_n. Sets spring, losses and the elastic share, adds to the force.
template <class Real>
inline void grain_friction(const GrainLaw& law, const GrainPairInput<Real>& in, const Triple<Real>& normal,
                           const Real& closing, const Real& pressed, GrainContact<Real>& out) {
  constexpr double tiny = 1e-300;  // keeps a spring of length zero from dividing by zero
  const Real k = Real{} + law.stiffness, half_k = Real{} + 0.5 * law.stiffness;
  const Triple<Real> flat = add_scaled(in.spring, -dot(normal, in.spring), normal);
  const Real turn = root(dot(in.spring, in.spring) / larger(dot(flat, flat), Real{} + tiny));
  const Triple<Real> old = {flat.x * turn, flat.y * turn, flat.z * turn};
  const Triple<Real> across = add_scaled(in.slip, closing, normal);
  const Triple<Real> trial = {old.x + across.x, old.y + across.y, old.z + across.z};
  const Real cap = pressed * (law.friction / law.stiffness), length2 = dot(trial, trial);
  Real keep = Real{} + 1.0;
  const auto slides = length2 > cap * cap;
  if (any(slides)) keep = choose(slides, cap / root(larger(length2, Real{} + tiny)), keep);
  out.spring = {trial.x * keep, trial.y * keep, trial.z * keep};
  const Triple<Real> both = {old.x + out.spring.x, old.y + out.spring.y, old.z + out.spring.z};
  const Triple<Real> lost = {trial.x - out.spring.x, trial.y - out.spring.y, trial.z - out.spring.z};
  out.friction_loss = half_k * dot(both, lost);
  out.elastic = out.elastic + half_k * dot(out.spring, out.spring);
  out.force = add_scaled(out.force, -k, out.spring);
}

template <bool Friction, bool Damping, class Real>
inline GrainContact<Real> grain_contact(const GrainLaw& law, const GrainPairInput<Real>& in) {
  const Real zero = Real{}, k = zero + law.stiffness;
  const Real distance = root(dot(in.separation, in.separation));
  const Real inverse = 1.0 / larger(distance, zero + 1e-150);  // two centres in one point: no direction, no force
  const Triple<Real> normal = {in.separation.x * inverse, in.separation.y * inverse, in.separation.z * inverse};
  GrainContact<Real> out;
  out.spring = {zero, zero, zero}, out.friction_loss = zero, out.damping_loss = zero;
  out.overlap = larger(in.reach - distance, zero);
  const Real spring_force = k * out.overlap;
  out.elastic = 0.5 * spring_force * out.overlap;
  Real pressed = spring_force, closing = zero;
  if constexpr (Friction || Damping) closing = -dot(in.slip, normal);
  if constexpr (Damping) {
    pressed = choose(out.overlap > zero, larger(spring_force + in.dashpot_per_step * closing, zero), zero);
    out.damping_loss = (pressed - spring_force) * closing;
  }
  out.force = {normal.x * pressed, normal.y * pressed, normal.z * pressed};
  if constexpr (Friction) grain_friction(law, in, normal, closing, pressed, out);
  return out;
}

/// A grain with its centre `height` above a mirror plane touches its own image: overlap 2 (r - height), closing twice
/// its own approach, no slip by symmetry. Half of the pair's energy and losses belong to the grain.
struct MirrorContact {
  double force = 0.0;         // N on the grain, away from the plane
  double elastic = 0.0;       // J
  double damping_loss = 0.0;  // J in this step
};

inline MirrorContact mirror_contact(const GrainLaw& law, double height, double radius, double approach,
                                    double dashpot_per_step) {
  const double overlap = 2.0 * (radius - height), closing = 2.0 * approach;
  if (overlap <= 0.0) return {};
  const double spring_force = law.stiffness * overlap;
  const double pressed = larger(spring_force + dashpot_per_step * closing, 0.0);
  return {pressed, 0.25 * spring_force * overlap, 0.5 * (pressed - spring_force) * closing};
}

/// c / dt [N/m] of a pair; `inverse_masses` = 1/m_i + 1/m_j = 1/m_red. Zero before the first displacement (dt = 0).
template <class Real>
inline Real dashpot_over_step(const GrainLaw& law, const Real& inverse_masses, double dt) {
  if (!(dt > 0.0)) return Real{};
  return (2.0 * law.damping / dt) * root((Real{} + law.stiffness) / inverse_masses);
}

}  // namespace standoff::particles
