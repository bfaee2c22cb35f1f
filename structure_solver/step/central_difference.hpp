#pragma once
// Stage integrate: explicit central differences written so that displacement and velocity are both known at t_n.
//   v_{n+1/2} = v_n + dt/2 a_n,   u_{n+1} = u_n + dt v_{n+1/2},   v_{n+1} = v_{n+1/2} + dt/2 a_{n+1}
//   a = (fe - f) / m
// Algebraically the leapfrog with velocities at half steps: v_{n+1/2} = v_{n-1/2} + a_n (dt_{n-1/2} + dt_{n+1/2}) / 2.
// Source: Belytschko, Liu, Moran, Nonlinear Finite Elements for Continua and Structures, sec. 6.2. Stable while
// dt <= 2 / omega_max. The force is held over the step, so its impulse is dt fe, exactly.
#include <cstdint>
#include <vector>

#include "structure_solver/ledger/plate_books.hpp"
#include "structure_solver/mesh/plate_edges.hpp"

namespace standoff::structure {

/// The step of the explicit plate as a share of the stable one, 2 / omega_max. Below 1 a linear plate is stable; in a
/// nonlinear one a mode whose period is three steps, omega dt = sqrt 3, drives itself, and nothing damps it in elastic
/// metal: the third-order resonance of central differences [Schlick, Mandziuk, Skeel, Srinivas, J. Comput. Phys. 140
/// (1998) 1, where the scheme is called Verlet's]. At 0.8 the fastest mode has omega dt = 1.6, 8 % below, which leaves
/// room for modes that stiffen under load.
inline constexpr double step_safety = 0.8;

struct NodalState {
  std::vector<Vec3> u, v;                // m, m/s
  std::vector<Vec3> internal, external;  // N: resisting force of the elements; load
  std::vector<Vec3> inverse_mass;        // 1/kg, zero for a fixed component
  std::vector<double> mass;              // kg
  std::vector<Hinge> hinges;             // of a pinned edge; empty otherwise

  template <class Archive>
  void archive(Archive& a) {
    a(u, v, internal, external);  // masses follow from the case
  }
};

constexpr Vec3 by_component(const Vec3& a, const Vec3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

/// Impulse of half a step at node i, received and from its supports.
inline HalfStepSums half_step_impulse(const NodalState& s, std::size_t i, double half_dt) {
  const Vec3& free = s.inverse_mass[i];
  const Vec3 held = s.internal[i] - s.external[i];  // what a support must carry
  return {0.0,
          half_dt * s.external[i],
          {free.x == 0.0 ? half_dt * held.x : 0.0, free.y == 0.0 ? half_dt * held.y : 0.0,
           free.z == 0.0 ? half_dt * held.z : 0.0}};
}

inline void kick(NodalState& s, std::size_t i, double half_dt) {
  s.v[i] += by_component(half_dt * s.inverse_mass[i], s.external[i] - s.internal[i]);
}

/// After a kick: takes out of every hinge the motion that both nodes share. Equal masses, so it is the force of the
/// constraint, without work. `drift` is the time for which the nodes have already moved with the shared motion [s].
inline HalfStepSums hold_hinges(NodalState& s, double drift) {
  HalfStepSums sums;
  for (const Hinge& hinge : s.hinges) {
    const auto a = static_cast<std::size_t>(hinge.lower), b = static_cast<std::size_t>(hinge.upper);
    const auto c = hinge.component;
    const double shared = 0.5 * (s.v[a].*c + s.v[b].*c);
    for (const std::size_t i : {a, b}) {
      s.v[i].*c -= shared;
      s.u[i].*c -= drift * shared;
      sums.of_supports.*c -= s.mass[i] * shared;
      sums.work -= drift * shared * (s.external[i].*c);
    }
  }
  return sums;
}

/// First half: kick with the force at t_n, then drift.
inline HalfStepSums kick_and_drift(NodalState& s, double dt, int threads) {
  HalfStepSums all = ordered_sum<HalfStepSums>(s.u.size(), threads, [&](std::size_t begin, std::size_t end) {
    HalfStepSums sums;
    for (std::size_t i = begin; i < end; ++i) {
      sums += half_step_impulse(s, i, 0.5 * dt);
      kick(s, i, 0.5 * dt);
      const Vec3 move = dt * s.v[i];
      s.u[i] += move;
      sums.work += dot(s.external[i], move);
    }
    return sums;
  });
  all += hold_hinges(s, dt);
  return all;
}

/// Second half: kick with the force at t_{n+1}, which force_at(i) delivers.
template <class Force>
HalfStepSums kick_with(NodalState& s, double dt, int threads, const Force& force_at) {
  HalfStepSums all = ordered_sum<HalfStepSums>(s.u.size(), threads, [&](std::size_t begin, std::size_t end) {
    HalfStepSums sums;
    for (std::size_t i = begin; i < end; ++i) {
      s.internal[i] = force_at(i);
      kick(s, i, 0.5 * dt);
      sums += half_step_impulse(s, i, 0.5 * dt);
    }
    return sums;
  });
  all += hold_hinges(s, 0.0);
  return all;
}

}  // namespace standoff::structure
