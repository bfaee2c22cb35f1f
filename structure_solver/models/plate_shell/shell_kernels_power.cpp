#include "structure_solver/models/plate_shell/shell_kernels_body.hpp"

namespace standoff::structure {
template ShellKernel choose_shell_kernel_with_rate<RateLaw::power>(const MetalEffects&);
}  // namespace standoff::structure
