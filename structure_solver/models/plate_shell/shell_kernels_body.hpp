#pragma once
// Definition behind shell_kernels.hpp; included only by the files that instantiate it.
#include "structure_solver/models/plate_shell/shell_kernels.hpp"

namespace standoff::structure {

template <class Law>
ShellKernel shell_kernel_of() {
  return {&shell_force<Law>, &shell_stress<Law>, layout_of<Law>};
}

template <RateLaw Rate>
ShellKernel choose_shell_kernel_with_rate(const MetalEffects& effects) {
  return with_metal<Rate>(effects, []<class Law>() { return shell_kernel_of<Law>(); });
}

}  // namespace standoff::structure
