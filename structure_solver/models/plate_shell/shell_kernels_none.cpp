#include "structure_solver/models/plate_shell/shell_kernels_body.hpp"

namespace standoff::structure {
template ShellKernel choose_shell_kernel_with_rate<RateLaw::none>(const MetalEffects&);

ShellKernel elastic_shell_kernel() {
  return shell_kernel_of<Elastic>();
}

ShellKernel choose_shell_kernel(const MetalEffects& effects) {
  if (!effects.plasticity) return elastic_shell_kernel();
  if (effects.rate == RateLaw::power) return choose_shell_kernel_with_rate<RateLaw::power>(effects);
  if (effects.rate == RateLaw::logarithmic) return choose_shell_kernel_with_rate<RateLaw::logarithmic>(effects);
  return choose_shell_kernel_with_rate<RateLaw::none>(effects);
}
}  // namespace standoff::structure
