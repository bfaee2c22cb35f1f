#include "structure_solver/step/batch_kernel_body.hpp"

namespace standoff::structure {
template KernelChoice choose_kernel_with_rate<RateLaw::none>(const MetalEffects&, ElementKind);

KernelChoice elastic_kernel(ElementKind kind) {
  return choice_of<Elastic>(kind);
}
}  // namespace standoff::structure
