#pragma once
// The force kernel of a batch of four elements, compiled once for every combination of effects and chosen once, before
// the time loop: an effect that is off has no instruction and no memory in it.
#include <cstdint>

#include "coupling/base/vec3.hpp"
#include "structure_solver/step/hex64_force.hpp"

namespace standoff::structure {

/// Which effects the scene calls for.
struct MetalEffects {
  bool plasticity = true;
  Hardening hardening = Hardening::power;
  RateLaw rate = RateLaw::power;
  bool heating = true, expansion = true;
};

/// Where a field lies in the history of a Gauss point; -1 is absent. And whether temperature strains.
struct HistoryLayout {
  int fields = 0, strain = -1, temperature = -1, static_stress = -1, x = -1;
  bool expansion = false;
};

struct BatchSums {
  double elastic[4], inelastic[4];
  unsigned sound;  // bit per lane
};

/// nodes[4 * local + lane] -> displacement u; force[64 * component + local].
using BatchKernel = BatchSums (*)(const MetalParameters&, const BoxGeometry&, const PointStep&, bool commit,
                                  const Vec3* u, const std::int32_t* nodes, Pack4* history, Pack4* force);

struct KernelChoice {
  BatchKernel kernel = nullptr;
  HistoryLayout layout;
};

KernelChoice choose_kernel(const MetalEffects& effects);
KernelChoice elastic_kernel();

/// One choice per file, so that they compile side by side.
template <RateLaw Rate>
KernelChoice choose_kernel_with_rate(const MetalEffects& effects);
extern template KernelChoice choose_kernel_with_rate<RateLaw::none>(const MetalEffects&);
extern template KernelChoice choose_kernel_with_rate<RateLaw::power>(const MetalEffects&);
extern template KernelChoice choose_kernel_with_rate<RateLaw::logarithmic>(const MetalEffects&);

}  // namespace standoff::structure
