#pragma once
// Definition behind shell_kernels.hpp; included only by the files that instantiate it.
#include "structure_solver/models/plate_shell/shell_kernels.hpp"

namespace standoff::structure {

template <class Law>
ShellKernel shell_kernel_of() {
  return {&shell_force<Law>,
          &shell_stress<Law>,
          {Law::fields, Law::strain_field, Law::temperature_field, Law::static_stress_field, Law::x_field}};
}

template <Hardening Hard, RateLaw Rate>
ShellKernel shell_kernel_with_heat(const MetalEffects& e) {
  if (!e.heating) return shell_kernel_of<Metal<Hard, Rate, false, false>>();
  return e.expansion ? shell_kernel_of<Metal<Hard, Rate, true, true>>()
                     : shell_kernel_of<Metal<Hard, Rate, true, false>>();
}

template <RateLaw Rate>
ShellKernel choose_shell_kernel_with_rate(const MetalEffects& e) {
  if (e.hardening == Hardening::power) return shell_kernel_with_heat<Hardening::power, Rate>(e);
  if (e.hardening == Hardening::table) return shell_kernel_with_heat<Hardening::table, Rate>(e);
  return shell_kernel_with_heat<Hardening::none, Rate>(e);
}

}  // namespace standoff::structure
