#pragma once
// The force kernel of a shell, compiled once for every combination of effects and chosen once, before the time loop: an
// effect that is off has no instruction and no memory in it.
#include "structure_solver/models/plate_shell/shell_element.hpp"
#include "structure_solver/step/point_laws.hpp"

namespace standoff::structure {

struct ShellKernel {
  ShellSums (*force)(const MetalParameters&, const ShellGeometry&, double thickness, const PointStep&, bool commit,
                     const ShellMotion&, Pack4* history, ShellForces&) = nullptr;
  std::array<Pack4, shell_layers> (*stress)(const MetalParameters&, const ShellGeometry&, double thickness,
                                            const ShellMotion&, const Pack4* history) = nullptr;
  HistoryLayout layout;  // of the metal; the thickness stretch follows at layout.fields
};

ShellKernel choose_shell_kernel(const MetalEffects& effects);
ShellKernel elastic_shell_kernel();

/// One choice per file, so that they compile side by side.
template <RateLaw Rate>
ShellKernel choose_shell_kernel_with_rate(const MetalEffects& effects);
extern template ShellKernel choose_shell_kernel_with_rate<RateLaw::none>(const MetalEffects&);
extern template ShellKernel choose_shell_kernel_with_rate<RateLaw::power>(const MetalEffects&);
extern template ShellKernel choose_shell_kernel_with_rate<RateLaw::logarithmic>(const MetalEffects&);

}  // namespace standoff::structure
