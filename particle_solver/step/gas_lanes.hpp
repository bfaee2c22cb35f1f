#pragma once
// The paths of all bodies once more, one array a component, so that the search can test four candidates at a time
// (AVX2).
//
// The test keeps a candidate if and only if its first contact with distance D falls in [from, until] while approaching:
// with a, b, c of kernels/gas_impact_time.hpp and tau = until - from,
//   b < 0  and  ( c <= 0   or   b^2 > a c  and  ( a tau^2 + 2 b tau + c <= 0  or  a tau > -b ) ),
// since the distance falls until tau = -b/a. That needs no root and no division; the few that are kept go through the
// exact kernel. Reading a run four at a time may look past its end: those are bodies like any other, so they do no
// harm, and `pad` bodies at rest far away close the arrays.
#include <algorithm>
#include <cstring>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::particles::gas {

using Pack = double __attribute__((vector_size(32)));  // four doubles
using PackMask = long long __attribute__((vector_size(32)));

inline Pack pack(double value) {
  return Pack{value, value, value, value};
}
inline Pack load_pack(const double* first) {
  Pack result;
  std::memcpy(&result, first, sizeof(result));
  return result;
}
/// To the nearest whole number, ties to even, |x| < 2^51: odd in x, so an image is the same seen from either body.
template <class Value>
Value nearest_whole(Value x) {
  constexpr double magic = 0x1.8p52;
  return (x + magic) - magic;
}

class Lanes {
 public:
  static constexpr std::size_t pad = 4;

  void resize(std::size_t count) {
    for (auto* values : {&x, &y, &z, &vx, &vy, &vz, &since}) values->resize(count + pad);
    for (auto* values : {&y, &z, &vx, &vy, &vz, &since}) std::fill(values->end() - pad, values->end(), 0.0);
    for (std::size_t k = count; k < count + pad; ++k) x[k] = 1e30;
  }
  void set(std::size_t p, const Vec3& start, const Vec3& velocity, double last_hit) {
    x[p] = start.x, y[p] = start.y, z[p] = start.z;
    vx[p] = velocity.x, vy[p] = velocity.y, vz[p] = velocity.z;
    since[p] = last_hit;
  }

  std::vector<double> x, y, z, vx, vy, vz, since;
  std::vector<double> contact;  // m, centre distance at contact with gas; grains only, filled by the owner
};

/// What a search compares four candidates with.
struct Probe {
  Vec3 start, velocity;
  double since = 0.0, contact = 0.0, until = 0.0;
  double side = 0.0;  // of the periodic cube
};

enum class Partner { gas, gas_in_periodic_cube, grain };

/// Bit l is set if body p + l is hit in time.
template <Partner Kind>
[[gnu::always_inline]] inline int hit_in_time(const Lanes& lanes, std::size_t p, const Probe& me) {
  Pack rx = load_pack(&lanes.x[p]) - me.start.x, ry = load_pack(&lanes.y[p]) - me.start.y,
       rz = load_pack(&lanes.z[p]) - me.start.z;
  const Pack wx = load_pack(&lanes.vx[p]) - me.velocity.x, wy = load_pack(&lanes.vy[p]) - me.velocity.y,
             wz = load_pack(&lanes.vz[p]) - me.velocity.z;
  if constexpr (Kind == Partner::gas_in_periodic_cube) {
    const double inverse = 1.0 / me.side;
    rx -= me.side * nearest_whole(rx * inverse), ry -= me.side * nearest_whole(ry * inverse),
        rz -= me.side * nearest_whole(rz * inverse);
  }
  Pack contact = pack(me.contact);
  if constexpr (Kind == Partner::grain) contact = load_pack(&lanes.contact[p]);
  const Pack other = load_pack(&lanes.since[p]), mine = pack(me.since);
  const Pack from = other > mine ? other : mine;
  rx += wx * from, ry += wy * from, rz += wz * from;
  const Pack a = wx * wx + wy * wy + wz * wz, b = rx * wx + ry * wy + rz * wz,
             c = rx * rx + ry * ry + rz * rz - contact * contact;
  const Pack tau = me.until - from, a_tau = a * tau;
  const PackMask meets = (c <= 0.0) | ((b * b > a * c) & (((a_tau + 2.0 * b) * tau + c <= 0.0) | (a_tau > -b)));
  const PackMask keep = (b < 0.0) & (tau >= 0.0) & meets;
  return static_cast<int>((keep[0] & 1) | (keep[1] & 2) | (keep[2] & 4) | (keep[3] & 8));
}

}  // namespace standoff::particles::gas
