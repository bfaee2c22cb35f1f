#pragma once
// Memory of a particle with its share of all lists [bytes], at the peak of a run: what the plan foretells. Measured,
// and held to it, by tests/verification/particles_memory_slow_test.cpp.
namespace standoff {

inline constexpr double gas_bytes = 140.0, air_bytes = 120.0;
inline constexpr double grain_bytes = 300.0, history_bytes = 80.0;  // a grain; what sliding adds to it

}  // namespace standoff
