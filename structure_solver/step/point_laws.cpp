#include "structure_solver/step/point_laws.hpp"

namespace standoff::structure {
namespace {

template <RateLaw Rate>
PointLaw law_with_rate(const MetalEffects& effects, Width width) {
  PointLaw law = four_lane_law<Rate>(effects);
  if (width == Width::eight_lanes) law.update = eight_lane_update<Rate>(effects);
  return law;
}

}  // namespace

Width widest_here() {
  const bool eight =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return eight ? Width::eight_lanes : Width::four_lanes;
}

PointLaw choose_point_law(const MetalEffects& effects, Width width) {
  if (!effects.plasticity) return {&update_points<Elastic, Pack4>, layout_of<Elastic>};
  switch (effects.rate) {
    case RateLaw::power:
      return law_with_rate<RateLaw::power>(effects, width);
    case RateLaw::logarithmic:
      return law_with_rate<RateLaw::logarithmic>(effects, width);
    case RateLaw::none:
      break;
  }
  return law_with_rate<RateLaw::none>(effects, width);
}

}  // namespace standoff::structure
