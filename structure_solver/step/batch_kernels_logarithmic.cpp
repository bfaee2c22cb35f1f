#include "structure_solver/step/batch_kernel_body.hpp"

namespace standoff::structure {
template KernelChoice choose_kernel_with_rate<RateLaw::logarithmic>(const MetalEffects&, ElementKind);
}  // namespace standoff::structure
