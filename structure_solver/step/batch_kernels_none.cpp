#include "structure_solver/step/batch_kernel_body.hpp"

namespace standoff::structure {
template KernelChoice choose_kernel_with_rate<RateLaw::none>(const MetalEffects&, bool);

KernelChoice elastic_kernel(bool curved) {
  return choice_of<Elastic>(curved);
}
}  // namespace standoff::structure
