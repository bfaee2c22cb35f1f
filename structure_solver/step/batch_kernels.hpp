#pragma once
// The force kernel of a batch of four elements, compiled once for every combination of effects and chosen once, before
// the time loop: an effect that is off has no instruction and no memory in it.
#include <cstdint>

#include "coupling/base/vec3.hpp"
#include "structure_solver/step/hex_force.hpp"

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

/// How the elements of a batch lie at rest: boxes, or copies of one curved element, each turned about z by its own
/// angle. A turned element is computed in the frame of the first, history included: the law of the metal is isotropic.
struct BatchShape {
  BoxGeometry box;
  const CurvedGeometry* curved = nullptr;  // null: boxes
  Pack4 cosine, sine;                      // of the angle back to the frame of the first
};

/// Turns the first two components of all nodes by the angle of `cosine`, `sine`.
inline void turn(const Pack4& cosine, const Pack4& sine, Pack4 (&field)[3][hex_nodes]) {
  for (int a = 0; a < hex_nodes; ++a) {
    const Pack4 x = field[0][a], y = field[1][a];
    field[0][a] = cosine * x - sine * y;
    field[1][a] = sine * x + cosine * y;
  }
}

/// nodes[4 * local + lane] -> displacement u; force[count * component + local] of an element with `count` nodes; alpha:
/// the enhanced strain of elements with 8 nodes, null otherwise.
using BatchKernel = BatchSums (*)(const MetalParameters&, const BatchShape&, const PointStep&, bool commit,
                                  const Vec3* u, const std::int32_t* nodes, Pack4* history, Pack4* alpha, Pack4* force);

/// Which element of the family.
struct ElementKind {
  int nodes_per_edge = 4;
  bool curved = false;
};

struct KernelChoice {
  BatchKernel kernel = nullptr;
  HistoryLayout layout;
};

KernelChoice choose_kernel(const MetalEffects& effects, ElementKind kind);
KernelChoice elastic_kernel(ElementKind kind);

/// One choice per file, so that they compile side by side.
template <RateLaw Rate>
KernelChoice choose_kernel_with_rate(const MetalEffects& effects, ElementKind kind);
extern template KernelChoice choose_kernel_with_rate<RateLaw::none>(const MetalEffects&, ElementKind);
extern template KernelChoice choose_kernel_with_rate<RateLaw::power>(const MetalEffects&, ElementKind);
extern template KernelChoice choose_kernel_with_rate<RateLaw::logarithmic>(const MetalEffects&, ElementKind);

}  // namespace standoff::structure
