#pragma once
// Definition behind four_lane_law of point_laws.hpp; included only by the files that instantiate it.
#include "structure_solver/step/point_laws.hpp"

namespace standoff::structure {

template <RateLaw Rate>
PointLaw four_lane_law(const MetalEffects& effects) {
  return with_metal<Rate>(effects, []<class Law>() { return PointLaw{&update_points<Law, Pack4>, layout_of<Law>}; });
}

}  // namespace standoff::structure
