#pragma once
// Counter-based random numbers: a draw is a pure function of (seed, what it is for, who, when), so it does not depend
// on the order in which particles are visited or on the number of threads. Source: Salmon, Moraes, Dror, Shaw,
// "Parallel random numbers: as easy as 1, 2, 3", SC11 (2011): Philox4x32-10, sec. 3.3.
#include <array>
#include <cmath>
#include <cstdint>

namespace standoff {

using Philox4 = std::array<std::uint32_t, 4>;

/// Ten rounds of Philox4x32 on a 128-bit counter with a 64-bit key.
inline Philox4 philox4x32(Philox4 counter, std::uint64_t key) {
  auto k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = 0xD2511F53ull * counter[0], b = 0xCD9E8D57ull * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ k0, static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ k1, static_cast<std::uint32_t>(a)};
    k0 += 0x9E3779B9u, k1 += 0xBB67AE85u;
  }
  return counter;
}

/// What a stream of numbers is used for; keeps streams with the same ids apart.
enum class RandomUse : std::uint32_t {
  gas_velocity = 1,
  gas_position,
  internal_energy,
  cell_packing,
  cell_radius,
  cell_offset,
  boundary,
  air_fill,
  air_inflow,
  air_collision,
  test,
};

/// A short sequence of uniforms for one event, identified by (seed, use, a, b, step).
class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, RandomUse use, std::uint32_t a, std::uint32_t b = 0, std::uint32_t step = 0)
      : key_(seed * 0x9E3779B97F4A7C15ull + static_cast<std::uint64_t>(use)), counter_{a, b, step, 0} {}

  /// Uniform in the open interval (0, 1): 53 bits, never 0 and never 1.
  double uniform() {
    if (next_ == 2) refill();
    const std::uint64_t bits = (static_cast<std::uint64_t>(block_[2 * next_]) << 32) | block_[2 * next_ + 1];
    ++next_;
    return (static_cast<double>(bits >> 12) + 0.5) * 0x1.0p-52;
  }
  /// Standard normal (Box-Muller, the cosine branch).
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(6.283185307179586 * uniform());
  }

 private:
  void refill() {
    block_ = philox4x32(counter_, key_);
    ++counter_[3];
    next_ = 0;
  }
  std::uint64_t key_;
  Philox4 counter_;
  Philox4 block_{};
  int next_ = 2;
};

}  // namespace standoff
