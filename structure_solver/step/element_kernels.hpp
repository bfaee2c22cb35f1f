#pragma once
// The force kernel of a batch of four elements, one for each kind of element, chosen once before the time loop.
#include <cstdint>

#include "coupling/base/vec3.hpp"
#include "structure_solver/elements/hex_geometry.hpp"
#include "structure_solver/step/point_laws.hpp"

namespace standoff::structure {

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
using ElementKernel = BatchSums (*)(const MetalParameters&, const PointLaw&, const BatchShape&, const PointStep&,
                                    bool commit, const Vec3* u, const std::int32_t* nodes, Pack4* history, Pack4* alpha,
                                    Pack4* force);

/// Which element of the family.
struct ElementKind {
  int nodes_per_edge = 4;
  bool curved = false;
};

ElementKernel choose_element_kernel(ElementKind kind);

}  // namespace standoff::structure
