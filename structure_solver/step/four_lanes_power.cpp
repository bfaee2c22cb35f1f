#include "structure_solver/step/four_lanes.hpp"

namespace standoff::structure {
template PointLaw four_lane_law<RateLaw::power>(const MetalEffects&);
}  // namespace standoff::structure
