#include "structure_solver/step/four_lanes.hpp"

namespace standoff::structure {
template PointLaw four_lane_law<RateLaw::logarithmic>(const MetalEffects&);
}  // namespace standoff::structure
