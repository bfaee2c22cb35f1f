#include "structure_solver/step/batch_kernel_body.hpp"

namespace standoff::structure {
template KernelChoice choose_kernel_with_rate<RateLaw::none>(const MetalEffects&);

KernelChoice elastic_kernel() {
  return choice_of<Elastic>();
}
}  // namespace standoff::structure
