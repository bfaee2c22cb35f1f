#pragma once
// The discrete books of central differences: what a step with a force held constant adds, such that they close exactly.
//   momentum   m (v_{n+1} - v_n) = dt (fe - (f_n + f_{n+1}) / 2): received and support impulses use the same halves
//   energy     W = fe . (u_{n+1} - u_n), force times the way of its point: a load that follows the interpolated
//              motion of the surface finds the same work. In a linear structure stored plus kinetic energy changes by
//              exactly W while the force is held, up to dt^2/8 m a^2, which comes and goes.
// Sums run over chunks of fixed size, then over chunks in order: same bits for any number of threads.
#include <cstddef>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff::structure {

struct PlateBooks {
  double external_work = 0.0;   // J
  double inelastic_work = 0.0;  // J, on plastic and thermal strain
  double damping = 0.0;         // J
  Vec3 received, of_supports;   // N s
};

/// What half a step adds.
struct HalfStepSums {
  double work = 0.0;
  Vec3 received, of_supports;
  HalfStepSums& operator+=(const HalfStepSums& b) {
    work += b.work, received += b.received, of_supports += b.of_supports;
    return *this;
  }
};

inline constexpr std::size_t sum_chunk = 256;

/// Sum of body(begin, end) over chunks of 0 .. count, in order; the chunks are computed by `threads` threads.
template <class Sum, class Body>
Sum ordered_sum(std::size_t count, int threads, Body&& body) {
  const std::size_t chunks = (count + sum_chunk - 1) / sum_chunk;
  std::vector<Sum> part(chunks);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t c = 0; c < chunks; ++c) {
    const std::size_t begin = c * sum_chunk, end = begin + sum_chunk < count ? begin + sum_chunk : count;
    part[c] = body(begin, end);
  }
  Sum total{};
  for (const Sum& p : part) total += p;
  return total;
}

}  // namespace standoff::structure
