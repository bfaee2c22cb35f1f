#include "structure_solver/step/eight_lanes.hpp"

namespace standoff::structure {
template PointUpdate eight_lane_update<RateLaw::power>(const MetalEffects&);
}  // namespace standoff::structure
