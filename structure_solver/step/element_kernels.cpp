#include "structure_solver/step/element_kernels.hpp"

#include "structure_solver/step/hex8_force.hpp"
#include "structure_solver/step/hex_force.hpp"

namespace standoff::structure {
namespace {

template <int N, bool Curved>
BatchSums batch_kernel(const MetalParameters& metal, const PointLaw& law, const BatchShape& shape,
                       const PointStep& step, bool commit, const Vec3* u, const std::int32_t* nodes, Pack4* history,
                       Pack4* alpha, Pack4* force) {
  constexpr int count = N * N * N;
  Pack4 local[3][count];
  for (int a = 0; a < count; ++a) {
    const std::int32_t* n = nodes + 4 * a;
    const Vec3 &p = u[n[0]], &q = u[n[1]], &r = u[n[2]], &s = u[n[3]];
    local[0][a] = Pack4(Pack4::Raw{p.x, q.x, r.x, s.x});
    local[1][a] = Pack4(Pack4::Raw{p.y, q.y, r.y, s.y});
    local[2][a] = Pack4(Pack4::Raw{p.z, q.z, r.z, s.z});
  }
  auto& out = *reinterpret_cast<Pack4(*)[3][count]>(force);
  auto answer = [&](int points, const double* weight, Pack4* gradient) {
    return law.update(metal, step, commit, points, weight, gradient, history);
  };
  ElementSums<Pack4> sums;
  static_assert(N == 4 || !Curved, "only pipe_hex64 is curved");
  if constexpr (N == 2) {
    sums = hex8_force_of(metal, BoxGeometryOf<2>::of_box(shape.box), step, commit, local, law.layout.fields, history,
                         *alpha, out, law.update);
  } else if constexpr (Curved) {
    turn(shape.cosine, shape.sine, local);
    sums = hex_force_of(*shape.curved, local, out, answer);
    turn(shape.cosine, -shape.sine, out);
  } else {
    sums = hex_force_of(BoxGeometryOf<N>::of_box(shape.box), local, out, answer);
  }
  BatchSums result{};
  for (int i = 0; i < 4; ++i) {
    result.elastic[i] = lane(sums.elastic, i);
    result.inelastic[i] = lane(sums.inelastic, i);
    result.sound |= static_cast<unsigned>(lane(sums.sound, i)) << i;
  }
  return result;
}

}  // namespace

ElementKernel choose_element_kernel(ElementKind kind) {
  if (kind.curved) return &batch_kernel<4, true>;
  if (kind.nodes_per_edge == 2) return &batch_kernel<2, false>;
  return kind.nodes_per_edge == 3 ? &batch_kernel<3, false> : &batch_kernel<4, false>;
}

}  // namespace standoff::structure
