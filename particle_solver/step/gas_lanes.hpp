#pragma once
// The paths of all bodies once more, as single-precision numbers, one array a component, so that the search can test
// eight candidates at a time (AVX2) in a quarter of a cache line each.
//
// The test must keep every candidate that is hit; one that is kept for nothing costs a look at the exact kernel
// (kernels/gas_impact_time.hpp), which decides. With u = v h the path of a sub-step [m], s = time / h, p = r + u from
// the gap where the searcher's own path begins, and tau = until - from, a body is hit at distance D only if it
// approaches and
//   |p| <= D   or   |p + u tau| <= D   or   the closest point lies before tau and |p|^2 - (p.u)^2 / |u|^2 <= D^2.
//
// Rounding. Numbers of size X (coordinates) and U (paths) are stored within 2^-24 of their size and gaps have a size of
// at most P = D + |u| + U when they matter, so distances are right within e = 2^-20 (X + U + P), squares of distances
// within 2^-20 P^2 beside that, and p.u within 4 e P: D^2 grows to (D + e)^2 + 2^-20 P^2. The sum of the largest
// contributions is a quarter of that. Far-away coordinates make the test weaker, never wrong.
//
// Reading a run eight at a time may look past its end: those are bodies like any other, so they do no harm, and `pad`
// bodies at rest far away close the arrays.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <immintrin.h>

#include "coupling/base/vec3.hpp"
#include "particle_solver/kernels/periodic_images.hpp"

namespace standoff::particles::gas {

using Pack = float __attribute__((vector_size(32)));  // eight floats
using PackMask = decltype(Pack{} < Pack{});

inline Pack load_pack(const float* first) {
  Pack result;
  std::memcpy(&result, first, sizeof(result));
  return result;
}
/// As in periodic_images.hpp, |x| < 2^22.
inline Pack nearest_whole(Pack x) {
  constexpr float magic = 0x1.8p23f;
  return (x + magic) - magic;
}

class Lanes {
 public:
  static constexpr std::size_t pad = 8;

  void resize(std::size_t count) {
    for (auto* values : {&x, &y, &z, &ux, &uy, &uz}) values->resize(count + pad);
    for (auto* values : {&y, &z, &ux, &uy, &uz}) std::fill(values->end() - pad, values->end(), 0.0f);
    std::fill(x.end() - pad, x.end(), 1e18f);
    farthest = longest = 0.0;
  }
  void set(std::size_t p, const Vec3& start, const Vec3& path) {
    x[p] = static_cast<float>(start.x), y[p] = static_cast<float>(start.y), z[p] = static_cast<float>(start.z);
    ux[p] = static_cast<float>(path.x), uy[p] = static_cast<float>(path.y), uz[p] = static_cast<float>(path.z);
  }
  /// To be called with every body that was set: sizes of the numbers, for the rounding.
  void measure(const Vec3& start, const Vec3& path) {
    farthest = std::max({farthest, std::abs(start.x), std::abs(start.y), std::abs(start.z)});
    longest = std::max({longest, std::abs(path.x), std::abs(path.y), std::abs(path.z)});
  }

  std::vector<float> x, y, z, ux, uy, uz;  // m
  std::vector<float> contact;              // m, centre distance at contact with gas; grains only, filled by the owner
  double farthest = 0.0, longest = 0.0;    // m, largest component of a start and of a path
};

/// What a search compares eight candidates with: the path of a body in [from, until], in parts of the sub-step.
struct Probe {
  Probe(const Lanes& lanes, const Vec3& start, const Vec3& path, double from, double until, double contact);
  /// For a scene that repeats.
  void repeat(const Period& period);
  void narrow(double until) { tau = static_cast<float>((until - from_) * (1.0 + 0x1p-20)); }

  float x, y, z, ux, uy, uz;  // m
  float from, tau;
  float slack, reach2, approach;       // m, m2, m2: e, D^2 with its margin, and 4 e P
  float margin2;                       // m2, 2^-20 P^2
  std::array<float, 3> side, inverse;  // m, 1/m: the period along each axis
  std::array<float, 3> half;           // m, farther apart rounding may take the other image for the nearest

 private:
  double from_;
};

[[gnu::always_inline]] inline Probe::Probe(const Lanes& lanes, const Vec3& start, const Vec3& path, double begin,
                                           double until, double contact)
    : x(static_cast<float>(start.x)),
      y(static_cast<float>(start.y)),
      z(static_cast<float>(start.z)),
      ux(static_cast<float>(path.x)),
      uy(static_cast<float>(path.y)),
      uz(static_cast<float>(path.z)),
      from(static_cast<float>(begin)),
      from_(begin) {
  const auto sum = [](const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
  const double long_path = 1.8 * lanes.longest, size = contact + sum(path) + long_path;
  const double error = 0x1p-20 * (lanes.farthest + sum(start) + long_path + size);
  const double grown = contact + error, squares = 0x1p-20 * size * size;
  slack = static_cast<float>(error);
  margin2 = static_cast<float>(squares);
  reach2 = static_cast<float>(grown * grown + squares);
  approach = static_cast<float>(4.0 * error * size);
  narrow(until);
}

inline void Probe::repeat(const Period& period) {
  const double length[3] = {period.length.x, period.length.y, period.length.z};
  const double per_length[3] = {period.per_length.x, period.per_length.y, period.per_length.z};
  for (std::size_t a = 0; a < 3; ++a) {
    side[a] = static_cast<float>(length[a]), inverse[a] = static_cast<float>(per_length[a]);
    half[a] = length[a] > 0.0 ? 0.5f * side[a] - 4.0f * slack : std::numeric_limits<float>::infinity();
  }
}

enum class Partner { gas, grain };

/// Bit l is set if body p + l may be hit in time.
template <Partner Kind, bool Periodic = false>
[[gnu::always_inline]] inline unsigned hit_in_time(const Lanes& lanes, std::size_t p, const Probe& me) {
  Pack rx = load_pack(&lanes.x[p]) - me.x, ry = load_pack(&lanes.y[p]) - me.y, rz = load_pack(&lanes.z[p]) - me.z;
  const Pack wx = load_pack(&lanes.ux[p]) - me.ux, wy = load_pack(&lanes.uy[p]) - me.uy,
             wz = load_pack(&lanes.uz[p]) - me.uz;
  PackMask between_images{};
  if constexpr (Periodic) {
    const auto image = [&](Pack& r, std::size_t axis) {
      r -= me.side[axis] * nearest_whole(r * me.inverse[axis]);
      between_images |= (r > me.half[axis]) | (r < -me.half[axis]);
    };
    image(rx, 0), image(ry, 1), image(rz, 2);
  }
  Pack reach2 = Pack{} + me.reach2;
  if constexpr (Kind == Partner::grain) {
    const Pack contact = load_pack(&lanes.contact[p]) + me.slack;
    reach2 = contact * contact + me.margin2;
  }
  rx += wx * me.from, ry += wy * me.from, rz += wz * me.from;
  const Pack ex = rx + wx * me.tau, ey = ry + wy * me.tau, ez = rz + wz * me.tau;
  const Pack a = wx * wx + wy * wy + wz * wz, b = rx * wx + ry * wy + rz * wz, c = rx * rx + ry * ry + rz * rz - reach2,
             e = ex * ex + ey * ey + ez * ez - reach2;
  const PackMask ends_near = (e <= 0.0f) | ((a * me.tau > -b) & (b * b > a * c));
  const PackMask keep = ((c <= 0.0f) & (b < me.approach)) | ((b < 0.0f) & ends_near) | between_images;
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(keep)));
}

}  // namespace standoff::particles::gas
